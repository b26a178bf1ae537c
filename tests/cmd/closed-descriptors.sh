# Where stdin, stdout or stderr is closed, no file takes its place.
mr-make torus -n 100 | mr-export torus.obj
mr-import -v torus.obj -o open.mrs 2>note
mr-import -v torus.obj -o closed.mrs 2>&-
mr-info open.mrs >open.txt
mr-info closed.mrs | cmp - open.txt && echo 'the same without stderr'
mr-make torus -n 100 >&-
echo "without stdout: exit $?"
mr-info <&-
echo "without stdin: exit $?"
mr-import -v torus.obj -o none.mrs <&- >&- 2>&-
echo "without any: exit $?"
mr-info none.mrs | cmp - open.txt && echo 'the same'
for tool in export info render compare; do
	mr-$tool out.obj <&- >&- 2>&-
	echo "mr-$tool: exit $?"
done
echo 'help that cannot be written, and a file without a name'
mr-make --help >/dev/full
echo $?
mr-make -o '' cube
echo $?
mr-info -o '' open.mrs
echo $?
