# From a file to a pipe mr-cat reaches at least 0.7 of the rate of cat: the best of several runs each.
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
for i in range(8):
    for command in "cat", "mr-cat --no-history":
        best[command] = min(best.get(command, 1e9), seconds(command + " big.mrs | cat >/dev/null"))
rate = best["cat"] / best["mr-cat --no-history"]
print("mr-cat: %.2f of the rate of cat" % rate)
sys.exit(rate < 0.7)
END
