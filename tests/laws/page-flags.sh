# The page repeats histories: it knows all tools that can stand in one, and which of their options have no value.
python3 - "$TOP/formats/page/paint/recipe.js" "$BUILD/bin" <<'X'
import os, re, subprocess, sys
said, failed = {}, 0
block = re.search(r"FLAGS = \{\n(.*?)\n\};", open(sys.argv[1]).read(), re.S).group(1)
for tool, flags in re.findall(r'"(mr-[a-z]+)": \[(.*)\],', block):
	said[tool] = set(re.findall(r'"(-[^"]+)"', flags))
common = {"-k", "--keep-going", "--sync", "--no-history", "-v", "--verbose", "-q", "--quiet", "-h", "--help", "-V", "--version"}
for tool in sorted(os.listdir(sys.argv[2])):
	help = subprocess.run([os.path.join(sys.argv[2], tool), "--help"], capture_output=True, text=True, check=True).stdout
	sink = tool[3:] in ("compare", "export", "info", "render", "view")
	flags = set()
	for short, long in re.findall(r"^ +(-[a-zA-Z], )?(--[a-z-]+)(?: {2,}|$)", help, re.M):
		flags |= {long} | ({short[:2]} if short else set())
	if sink and tool in said or not sink and said.get(tool) != flags - common:
		print("%s: recipe.js has %s, --help %s" % (tool, sorted(said.get(tool, {"nothing"})), "a sink" if sink else sorted(flags - common)))
		failed = 1
sys.exit(failed or not said)
X
