# options.awk -- the options of the tools that change a stream, from their own tables, as a module of the page.
# usage: awk -f options.awk cmd/cmd.c cmd/mr-*.c; of cmd.c those that tools share, as "".  Each option: its letter, or an empty
# text, its long name, what kind of value it has, and how --help calls that.
function flush() {
	if (tool != "" && !sink)
		printf "\t\"%s\": [%s],\n", tool == "cmd" ? "" : tool, out
}
FNR == 1 {
	flush()
	tool = FILENAME
	sub(/.*\//, "", tool)
	sub(/\.c$/, "", tool)
	out = rest = ""
	sink = inside = 0
}
NR == 1 { print "export const OPTIONS = {" }
/\.sink = true/ { sink = tool != "cmd" }
/const cmd_opt (table|standard)\[\] = \{/ { inside = 1; next }
inside && /^\t+\};/ || /^\};/ { inside = 0 }
inside {
	gsub(/^[ \t]+/, "")
	rest = rest (rest ~ /,$/ ? " " : "") $0
	if (match(rest, /^\{ ('.'|0), "[a-z-]+", CMD_[A-Z]+, [^"]*("[^"]*"|NULL),/)) {
		split(substr(rest, 1, RLENGTH - 1), field, ", ")
		letter = field[1] ~ /'/ ? "-" substr(field[1], 4, 1) : ""
		name = substr(field[2], 2, length(field[2]) - 2)
		sub(/CMD_/, "", field[3])
		out = out (out == "" ? "" : ", ") "[\"" letter "\", \"--" name "\", \"" tolower(field[3]) "\", " (field[7] == "NULL" ? "\"\"" : field[7]) "]"
		rest = "-"
	}
	if ($0 ~ /\},$/)
		rest = ""
}
END {
	flush()
	print "};"
}
