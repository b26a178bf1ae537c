# How time, memory and disk grow with size: each step of an edit and of a scan at five SIZES (vertices, and as many points),
# and the exponents, fitted to the logarithms over the three largest.  Time is that of the cores, which others' work hardly
# changes, and which is what a batch costs; memory is the most that the step takes, disk the stream that it writes.
figure() { # name, file: a number of a line of JSON, the first of that name
	grep -o "\"$1\":[^,}]*" "$2" | head -n 1 | cut -d : -f 2
}
cpu() { # of all that was waited for so far
	times >times && awk -F '[ms ]+' 'NR == 2 { print 60 * ($1 + $3) + $2 + $4 }' times
}
step() { # size, input, output, tool and options: a row of the table
	size=$1 in=$2 made=$3
	shift 3
	cpu >before
	"$@" --stats stats.json "$in" -o "$made" 2>err || { cat err; echo "$1 fails at $size"; return 1; }
	cpu >after
	echo "$kind-$1 $size $(cat after before | xargs | awk '{ print $1 - $2 }') $(figure peak_bytes stats.json) $(wc -c <"$made")" >>table
}
edit() { # vertices
	kind=edit
	mr-make bumpy -n "$1" | mr-export model.ply &&
	    step "$1" model.ply 0.mrs mr-import && step "$1" 0.mrs 1.mrs mr-smooth && step "$1" 1.mrs 2.mrs mr-remesh &&
	    step "$1" 2.mrs 3.mrs mr-select --free all --fixed below:y,0.3 --handle 0=above:y,0.8 &&
	    step "$1" 3.mrs 4.mrs mr-encode && step "$1" 4.mrs 5.mrs mr-pose --rotate 0,1,0,30 &&
	    step "$1" 5.mrs 6.mrs mr-solve && step "$1" 6.mrs 7.mrs mr-decode
}
scan() { # points
	kind=scan
	mr-make bumpy -n "$1" --points "$1" | mr-export cloud.xyz &&
	    step "$1" cloud.xyz 0.mrs mr-import --points && step "$1" 0.mrs 1.mrs mr-shrinkwrap && step "$1" 1.mrs 2.mrs mr-simplify &&
	    step "$1" 2.mrs 3.mrs mr-fit && step "$1" 3.mrs 4.mrs mr-sample && step "$1" 4.mrs 5.mrs mr-decode
}
fail=0
for size in ${SIZES:-10000 30000 100000 300000 1000000}; do
	edit "$size" && scan "$size" || { fail=1; break; }
done

awk 'function slope(name, column,    k, x, y, n, sx, sy, sxx, sxy) {
		for (k = count[name] > 3 ? count[name] - 2 : 1; k <= count[name]; k++) {
			x = log(value[name, k, 2]); y = log(value[name, k, column] + 1e-3)
			n++; sx += x; sy += y; sxx += x * x; sxy += x * y
		}
		return n > 1 ? sprintf("%.2f", (n * sxy - sx * sy) / (n * sxx - sx * sx)) : "-"
	}
	!($1 in count) { order[++names] = $1 }
	{ k = ++count[$1]; for (i = 2; i <= NF; i++) value[$1, k, i] = $i }
	END {
		for (j = 1; j <= names; j++) {
			name = order[j]
			printf "%s: seconds", name
			for (k = 1; k <= count[name]; k++) printf " %.3g", value[name, k, 3]
			printf " (n^%s), MB", slope(name, 3)
			for (k = 1; k <= count[name]; k++) printf " %.0f", value[name, k, 4] / 1e6
			printf " (n^%s), stream MB", slope(name, 4)
			for (k = 1; k <= count[name]; k++) printf " %.1f", value[name, k, 5] / 1e6
			printf " (n^%s)\n", slope(name, 5)
		}
	}' table
exit $fail
