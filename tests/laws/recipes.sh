# Each line of the tables of filters in mr-recipes(7) runs as it stands; its recipes run with the other pages' examples.
page=$TOP/man/mr-recipes.7
mr-make bumpy -n 800 | mr-crop --drop sphere:0,1.5,0,0.4 -o in.mrs &&
	mr-export in.mrs in.ply && mr-export in.mrs in.glb || exit
mr-make bumpy --texcoords -n 800 | mr-export in.obj
mr-make bumpy --noise 0.003 -n 800 | mr-export onto.ply
mr-make bumpy --points 800 | mr-export cloud.ply

sed -n '/^\.Sh FILTERS/,/^\.Sh SEE/s/^\.It .* Ta //p' "$page" >lines
[ "$(wc -l <lines)" -ge 40 ] || { echo "only $(wc -l <lines) lines"; exit 1; }
fail=0
while read -r line; do
	sh -c "$line" >out 2>said </dev/null && ! grep -v '\[repaired\]$' said || { echo "$line"; cat said; fail=1; }
done <lines
exit $fail
