# -k leaves out the file that fails, says so, and exits 1; without it nothing that could be taken for whole is written.
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n' >a.off
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n' >bad.off
mr-import -k a.off bad.off a.off >kept.mrs
echo "exit $?"
mr-info --json kept.mrs | grep -o '"frame":[0-9]*,"name":"[a-z]*"'
mr-import a.off bad.off a.off >cut.mrs
echo "exit $?"
mr-info cut.mrs >/dev/null
echo "exit $?"
echo '-- where nothing is left the old file stays, and every later tool fails'
cp kept.mrs old.mrs
mr-import -k bad.off bad.off -o old.mrs
echo "exit $?"
cmp kept.mrs old.mrs
mr-import -k bad.off | mr-smooth | mr-export '%d.obj'
echo "exit $?"
mr-import -k bad.off | mr-info -k
echo "exit $?"
ls *.mrs
