# The second stream has more frames than the first: what can be compared is, then it fails.
mr-make plane -n 4 >one.mrs
cat one.mrs one.mrs >two.mrs
cat one.mrs one.mrs one.mrs | mr-compare one.mrs | grep -c frame
mr-compare two.mrs <one.mrs >out
echo "exit $?, $(grep -c frame out) compared"
# with -k a frame that fails, and the deltas of it, count as frames of the first
mr-make plane -n 9 | mr-select --handle 0=all | mr-pose --frames 2 >posed.mrs
mr-smooth one.mrs | cat - posed.mrs >first.mrs
cat one.mrs posed.mrs >second.mrs
mr-compare -k -a base -b mesh second.mrs <first.mrs 2>err >out
echo "exit $?, $(grep -c frame out) compared" && cat err
cat one.mrs one.mrs one.mrs | mr-compare two.mrs >out
code=$?
echo "exit $code, $(grep -c frame out) compared"
exit $code
