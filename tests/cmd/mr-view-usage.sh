# Wrong command lines: exit 2, or 1 where a stream is not there, nothing on stdout, and no model overwritten.
mr-make cube -n 8 >cube.mrs
mr-export -i cube.mrs cube.off
for args in '' 'a.html absent.mrs' '-i cube.mrs a.html cube.mrs' 'a.png' 'cube.mrs' 'cube.off' 'a' '-l' '-o a.html b.html' '--nonsense a.html' '--pack a.html' '--pack 0 a.html' '--pack 20% a.html' '--pack 1% a.html' '--beside -'; do
	mr-view $args <cube.mrs >out 2>err
	echo "$args: exit $?, $(wc -c <out) bytes: $(head -n 1 err)"
done
mr-view -l '' -i cube.mrs a.html
echo "exit $?"
mr-view -i absent.mrs a.html
echo "exit $?"
mr-view -i cube.off model.html
echo "exit $?"
ls a.html 2>/dev/null
mr-info cube.mrs >/dev/null && echo 'the stream is there'
