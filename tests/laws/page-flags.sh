# The page repeats histories by the tools' tables of options, as --help shows them.
awk -f "$TOP/formats/page/paint/options.awk" "$TOP/cmd/cmd.c" "$TOP"/cmd/mr-*.c >options.js || exit
python3 - "$BUILD/bin" <<'X'
import json, os, re, subprocess, sys
text = open("options.js").read().replace("export const OPTIONS = ", "").rstrip().rstrip(";")
tables = json.loads(re.sub(r",\n\}$", "\n}", text))
bad = not tables
for tool in sorted(os.listdir(sys.argv[1])):
	help = subprocess.run([os.path.join(sys.argv[1], tool), "--help"], capture_output=True, text=True, check=True).stdout
	if tool[3:] in ("compare", "export", "info", "render", "view"):
		bad |= tool in tables
		continue
	shown = {name: (letter.strip(", "), metavar) for letter, name, metavar in
		re.findall(r"^ +(-[a-zA-Z], )?(--[a-z-]+)(?: (\S+))?(?: |$)", help, re.M)}
	mine = {name: (letter, metavar) for letter, name, _, metavar in tables[tool]}
	shared = {name: metavar for _, name, _, metavar in tables[""]}
	wrong = [n for n in mine if shown.get(n) != mine[n]] + [n for n in shown if n not in mine and shared.get(n) != shown[n][1]]
	if wrong:
		print(tool, wrong)
		bad = True
sys.exit(bad)
X
