# From a file to a pipe mr-cat, which verifies every byte, reaches at least 0.5 of the rate of cat, which looks at
# none: the best run of each.
[ -z "$SAN" ] || { echo 'sanitizers are slow'; exit 77; }
mr-make plane -n 1500000 >a.mrs || exit
cat a.mrs a.mrs a.mrs a.mrs >big.mrs
python3 - <<'END'
import subprocess, sys, time
def seconds(command):
    start = time.monotonic()
    subprocess.run(command, shell=True, check=True)
    return time.monotonic() - start
best = {}
for i in range(30): # other work on the machine disturbs either: so until the law is seen to hold
    for command in "cat", "mr-cat --no-history":
        best[command] = min(best.get(command, 1e9), seconds(command + " big.mrs | cat >/dev/null"))
    rate = best["cat"] / best["mr-cat --no-history"]
    if i >= 4 and rate >= 0.5:
        break
print("mr-cat: %.2f of the rate of cat, %d runs each" % (rate, i + 1))
sys.exit(rate < 0.5)
END
