# Every tool on models that none is glad of: a result that keeps what its page promises, or one sentence.  make matrix does so
# with real models, too.  All of them with LONG=1, else every fourth.
[ -n "$LONG" ] || export SPARSE=$((4 * SPARSE))
JOBS=1 "$TOP/tests/matrix/run" --small
