# Wrong command lines: exit 2, nothing on stdout.
mr-make cube -n 8 >cube.mrs
for args in '' 'a.png b.png' '-s 10x10 a.png' '-s 100 a.png' '-s 100x a.png' '--view sideways a.png' '--view 0,0,0 a.png' \
	'--range 3,2 a.png' '--up w a.png' 'a%q.png' 'cube.mrs'; do
	mr-render $args <cube.mrs >out 2>err
	echo "$args: exit $?, $(wc -c <out) bytes: $(head -n 1 err)"
done
# What is no stream, and where the stream goes.
mr-make sphere -n 42 | mr-export -f off - >x.off
mr-render -i x.off a.png
echo "exit $?"
mr-render x.off a.png
echo "exit $?"
mr-decode x.off
echo "exit $?"
mr-cat cube.mrs cube.mrs | mr-render -s 16x16 'name-%s.png'
echo "exit $?"
mr-cat cube.mrs cube.mrs | mr-render -s 16x16 'name-%s-%d.png'
ls name-*
