# boxes.awk -- from the figures of a cloud, mr-info --json, the boxes of four tiles and of the seams between them, a
# name and a predicate a line; fails where these did not come whole
function figure(name) {
	match($0, "\"" name "\":[^,}]*")
	return substr($0, RSTART + length(name) + 3, RLENGTH - length(name) - 3)
}
function box(name, x0, x1, y0, y1) {
	printf "%s box:%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", name, x0, y0, b[3] - far, x1, y1, b[6] + far
}
/^{.*}$/ {
	match($0, /"box":\[\[[^]]*\],\[[^]]*\]\]/)
	text = substr($0, RSTART + 6, RLENGTH - 6)
	gsub(/[][]/, "", text)
	split(text, b, ",")
	far = figure("diagonal")
	spacing = figure("spacing_median")
	print "spacing", spacing
	over = overlap * spacing
	x[0] = b[1] - far; x[1] = (b[1] + b[4]) / 2; x[2] = b[4] + far
	y[0] = b[2] - far; y[1] = (b[2] + b[5]) / 2; y[2] = b[5] + far
	for (i = 0; i < 2; i++) for (j = 0; j < 2; j++) {
		box(i j ".core", x[i], x[i + 1], y[j], y[j + 1])
		box(i j ".wide", x[i] - over, x[i + 1] + over, y[j] - over, y[j + 1] + over)
	}
	# A third of the overlap on either side, so that the neighbour has a surface, and no border, around it.
	for (j = 0; j < 2; j++) {
		box("0" j "-1" j, x[1] - over / 3, x[1] + over / 3, y[j], y[j + 1])
		box(j "0-" j "1", x[j], x[j + 1], y[1] - over / 3, y[1] + over / 3)
	}
}
END { exit !spacing }
