# An interrupt leaves no file that is not whole, of one for each frame neither.
mr-make sphere -n 300000 -o big.mrs
interrupted() { # SIGNAL PART COMMAND...
	signal=$1
	part=$2
	shift 2
	"$@" <big.mrs &
	until ls | grep -q "$part\."; do sleep 0.01; done
	kill -"$signal" $!
	wait $! 2>/dev/null
	echo "$signal: exit $?"
	ls
}
interrupted TERM 1.obj.gz mr-export '%d.obj.gz'
interrupted HUP 1.obj.gz mr-export 1.obj.gz
