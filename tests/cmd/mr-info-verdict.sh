# One word for each frame, by the findings that it carries.
mr-make sphere -n 200 -o good.mrs
PYTHONPATH="$TOP/examples" python3 - <<'X'
import mrstream
def frames():
	for lines in ([], [("lost", 3, 0)], [("lost", 3, 0), ("folded", 1, 900)], [("folded", 1, 900), ("crossing", 90, 900)]):
		for frame in mrstream.read("good.mrs"):
			if lines:
				frame.put("", "findings", "".join("mr-x\t%s\tmesh\t%d\t%d\t0\t0\t\t\t\t\t\n" % line for line in lines))
			yield frame
mrstream.write("all.mrs", frames())
X
mr-info --verdict all.mrs
