# Wrong command lines: exit 2 and no output; what cannot be aligned stays, with a finding.
mr-make bumpy -n 3000 -o a.mrs
mr-make knot -n 3000 | mr-transform --translate 9,9,9 -o b.mrs
mr-cat a.mrs b.mrs -o two.mrs
for wrong in '' 'a.mrs a.mrs a.mrs' '--from a,b a.mrs' '-m %x a.mrs' \
	'--all a.mrs a.mrs' '--all --scale a.mrs' '--all -m all.txt two.mrs'; do
	mr-align $wrong <a.mrs >out 2>err
	echo "$wrong: exit $?, $(wc -c <out) bytes"
	head -n 1 err
done
echo 'nothing fits'
mr-align --no-history -m motion.txt --stats stats.json a.mrs <b.mrs 2>err | mr-export -q -f obj - >stays.obj
mr-export -q -f obj - <b.mrs | cmp - stays.obj && echo stays
cat motion.txt err
grep -o '"findings.*' stats.json
echo 'too little, and nothing there'
printf '0 0 0\n1 0 0\n0 1 0\n1 1 1\n' >four.xyz
printf '1 2 3\n1 2 3\n' >one.xyz
for few in four one; do
	mr-import -q $few.xyz | mr-align a.mrs >out 2>err
	echo "exit $?: $(cat err)"
done
mr-align missing.mrs <a.mrs >out 2>err
echo "exit $?: $(cat err)"
mr-align --from base a.mrs <a.mrs >out 2>err
echo "exit $?: $(cat err)"
