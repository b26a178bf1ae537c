# A producer that stops for a while changes nothing, one that dies is one that failed: behind every byte with LONG=1, else some.
python3 "$TOP/tests/faults/by_output.py" stalls "$([ -n "$LONG" ] && echo 1 || echo $((97 * SPARSE)))"
