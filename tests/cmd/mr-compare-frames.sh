# The second stream has more frames than the first: what can be compared is, then it fails.
mr-make plane -n 4 >one.mrs
cat one.mrs one.mrs >two.mrs
cat one.mrs one.mrs one.mrs | mr-compare one.mrs | grep -c frame
mr-compare two.mrs <one.mrs >out
echo "exit $?, $(grep -c frame out) compared"
cat one.mrs one.mrs one.mrs | mr-compare two.mrs >out
code=$?
echo "exit $code, $(grep -c frame out) compared"
exit $code
