# The page has the colours of mr-render, and its names of regions: the numbers of formats/page/draw/colors.js are those of lib/render.
python3 - "$TOP" <<'X'
import re, sys
top, failed = sys.argv[1], 0
c = open(top + "/lib/render/colormap.c").read()
names = open(top + "/lib/render/picture.c").read()
js = open(top + "/formats/page/draw/colors.js").read()


def part(text, begin, end):
	"""What stands between the two, each a pattern."""
	found = re.search(begin + "(.*?)" + end, text, re.S)
	return found.group(1) if found else "nothing found behind " + begin


def numbers(text, least):
	found = [float(n) for n in re.findall(r"\d+\.?\d*", text)]
	return found if len(found) >= least else ["fewer than %d numbers" % least]


def same(what, ours, theirs):
	global failed
	if ours != theirs:
		print("%s: mr-render has %s, the page %s" % (what, ours, theirs))
		failed = 1


same("viridis", numbers(part(c, r"viridis\[\] = ", ";"), 27), numbers(part(js, "SEQUENTIAL = ", ";"), 27))
same("RdBu", numbers(part(c, r"blue_red\[\] = ", ";"), 27), numbers(part(js, "DIVERGING = ", ";"), 27))
same("kinds", numbers(part(c, r"table\[\] = ", ";"), 30), numbers(part(js, "KINDS = ", ";"), 30))
same("nothing", numbers(part(c, "grey = ", ";"), 3), numbers(part(js, "NOTHING = ", ";"), 3))
same("rounds", numbers(part(c, "kind / KINDS %", ";"), 1), numbers(part(js, r"kind / KINDS.length\) %", ";"), 1))
same("paler kinds", numbers(part(c, r"mix\(c.r,", r"\* round"), 2), numbers(part(js, r"Math.round\(c \+", r"\* round"), 2))
same("fixed", numbers(part(c, "== MR_REGION_FIXED.*?rgb", ";"), 3), numbers(part(js, r"region === 0 \? \[", r"\]"), 3))
same("free", numbers(part(c, "== MR_REGION_FREE.*?rgb", ";"), 3), numbers(part(js, r"region === 1 \? \[", r"\]"), 3))
same("names", re.findall(r'"([a-z]+)(?: %u)?"', part(names, "\nregion_name", "\n}")),
	[n.strip() for n in re.findall(r'"([a-z]+) ?"', part(js, "function regionName", "\n}"))])
sys.exit(failed)
X
