# A file that may have so many bytes and no more, as on a disk that is full: exit 1, one sentence, and what was there stays.  Every
# number of bytes with LONG=1.  And a folder that cannot be written to.
python3 "$TOP/tests/faults/by_output.py" full "$([ -n "$LONG" ] && echo 1 || echo $((97 * SPARSE)))" || exit

mr-make cube -n 8 -o cube.mrs
mkdir closed
echo old >closed/old
echo mrmesh1 >closed/old.mrs
chmod -R a-w closed
as=
if [ -w closed ]; then # by root, for whom nothing is closed
	as='setpriv --reuid=65534 --regid=65534 --clear-groups'
	$as mr-cat --version >out 2>&1 || { echo "nobody but root can run this"; exit 77; }
	chmod a+rx . && $as test -r cube.mrs || { echo "nobody but root can read this"; exit 77; }
fi
for command in 'mr-cat -o closed/new' 'mr-cat -o closed/old.mrs' 'mr-export -f obj closed/old' 'mr-export -f stl closed/new.gz' \
	'mr-info --stats closed/new' 'mr-render closed/new.png' 'mr-view closed/new.html'; do
	$as $command <cube.mrs >out 2>err
	code=$?
	[ $code -eq 1 ] && [ "$(wc -l <err)" -eq 1 ] && grep -q 'closed/.*Permission denied' err || { echo "$command: exit $code: $(cat err)"; exit 1; }
	[ "$(ls closed | wc -l)" = 2 ] && [ "$(cat closed/old closed/old.mrs)" = "$(printf 'old\nmrmesh1')" ] || { echo "$command leaves something"; exit 1; }
done
