# From a file to a pipe mr-cat, which verifies every byte, takes little more of the processor's time than cat, which looks at
# none, and zlib's crc32 of the file as it is mapped together: the best run of each.  cat alone would tell nothing: where other work
# keeps both ends of the pipe on one core, it needs a quarter of the time; nor would bytes that are there already: under some
# hypervisors mapping a page takes four times as long as its checksum.
[ -z "$SAN" ] || { echo 'sanitizers are slow'; exit 77; }
mr-make plane -n 1500000 >a.mrs || exit
cat a.mrs a.mrs a.mrs a.mrs >big.mrs
python3 - <<'END'
import mmap, resource, subprocess, sys, time, zlib
def spent():
    r = resource.getrusage(resource.RUSAGE_CHILDREN)
    return r.ru_utime + r.ru_stime
def piped(command):
    start = spent()
    subprocess.run(command + " big.mrs | cat >/dev/null", shell=True, check=True)
    return spent() - start
big = open("big.mrs", "rb")
def checksum():
    start = time.process_time()
    with mmap.mmap(big.fileno(), 0, access=mmap.ACCESS_READ) as mapped:
        zlib.crc32(mapped)
    return time.process_time() - start
cat = crc = mr_cat = 1e9
for i in range(30): # other work disturbs each: so until the law is seen to hold
    cat, crc, mr_cat = min(cat, piped("cat")), min(crc, checksum()), min(mr_cat, piped("mr-cat --no-history"))
    ratio = mr_cat / (cat + crc)
    if i >= 4 and ratio <= 1.25:
        break
print("mr-cat: %.2f of the time of cat and crc32 (%.0f, %.0f and %.0f ms), %d runs each" %
      (ratio, 1e3 * mr_cat, 1e3 * cat, 1e3 * crc, i + 1))
sys.exit(ratio > 1.25)
END
