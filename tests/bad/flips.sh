# A bit of a stream that comes the other way round is missed by no sink: every bit of its headers with LONG=1 and as many of
# what they stand before, else some.
python3 "$TOP/tests/faults/by_output.py" flips "$([ -n "$LONG" ] && echo 1 || echo $((97 * SPARSE)))"
