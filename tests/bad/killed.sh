# A stage of the two main pipes is killed at some moment: the last one fails and leaves nothing, or has the right result.
# 500 times with LONG=1.
# The signals are left to the tools: a sanitizer that takes one during its own last check waits for itself.
ASAN_OPTIONS=$ASAN_OPTIONS:handle_segv=0 python3 "$TOP/tests/faults/by_output.py" killed "$([ -n "$LONG" ] && echo 500 || echo 20)"
