# A stage of the two main pipes is killed at some moment: the last one fails and leaves nothing, or has the right result.
# 500 times with LONG=1.
python3 "$TOP/tests/faults/by_output.py" killed "$([ -n "$LONG" ] && echo 500 || echo 20)"
