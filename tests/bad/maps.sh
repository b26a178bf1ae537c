# A picture of heights that is cut anywhere or has any byte changed: exit 0 or 1, a sentence, and no half stream.
fail=0
cat >control.off <<'END'
OFF
4 4 0
1 1 1
-1 -1 1
-1 1 -1
1 -1 -1
3 0 2 1
3 0 1 3
3 0 3 2
3 1 2 3
END
mr-make sphere -n 100 -o sphere.mrs
mr-import -l control control.off | mr-cat --merge - sphere.mrs | mr-sample -q -n 1 | mr-map -w good -o mapped.mrs || exit
size=$(wc -c <good-height.png)
try() { # what was done
	mr-map -q -r bad.png mapped.mrs >out 2>err
	code=$?
	[ $code -eq 0 ] && return
	[ $code -eq 1 ] && [ "$(wc -l <err)" -eq 1 ] && ! mr-cat out >/dev/null 2>&1 || { echo "$1: exit $code: $(cat err)"; fail=1; }
}
at=0
while [ $at -lt "$size" ]; do
	head -c $at good-height.png >bad.png
	try "cut at $at"
	[ $code -eq 1 ] || { echo "cut at $at: exit $code"; fail=1; }
	{ cat bad.png; printf '\277'; tail -c +$((at + 2)) good-height.png; } >changed
	mv changed bad.png
	try "byte $at changed"
	at=$((at + 3))
done
exit $fail
