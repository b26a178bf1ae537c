# An interrupt leaves nothing behind, and an old file as it was.
mkfifo pipe
echo old >out.mrs
for signal in TERM HUP; do
	mr-cat -o out.mrs <pipe &
	exec 3>pipe
	until ls | grep -q 'out.mrs.*~'; do sleep 0.01; done
	kill -$signal $!
	wait $! 2>/dev/null
	echo "$signal: exit $?"
	exec 3>&-
	ls
done
cat out.mrs
