"""Makes the wheel of the package mr, tools included; usage: build_wheel.py VERSION PORTABLE TOP OUT

PORTABLE is a folder of .ci/portable, TOP that of the sources, OUT the folder of the wheel.  A wheel is a zip file of
what goes where, with a list of checksums (packaging.python.org, Binary distribution format).  Tools and libraries go to
bin/ and lib/mr/ of any prefix, where they find each other.  SOURCE_DATE_EPOCH is the time of the files in it.
"""
import base64
import hashlib
import os
import pathlib
import platform
import re
import subprocess
import sys
import time
import zipfile

METADATA = """\
Metadata-Version: 2.1
Name: mr-tools
Version: {version}
Summary: Multiresolution geometry: edit meshes with their detail, make light surfaces of scans
License: MIT AND GPL-2.0-or-later
Requires-Python: >=3.9
Requires-Dist: numpy
Description-Content-Type: text/markdown

"""
WHEEL = "Wheel-Version: 1.0\nGenerator: mr {version}\nRoot-Is-Purelib: false\nTag: {tag}\n"


def tag(programs):
    """The name of the oldest systems that have all of glibc that the programs ask for."""
    asked = {int(n) for program in programs for n in re.findall(rb"\0GLIBC_2\.(\d+)(?=\0)", program.read_bytes())}
    return f"py3-none-manylinux_2_{max(asked)}_{platform.machine()}"


def contents(version, portable, top):
    """What is in the wheel, but for its tag and checksums: bytes by name."""
    package = top / "lib/python/mr"
    described = subprocess.run([portable / "bin/mr", "--json"], stdout=subprocess.PIPE, check=True).stdout
    tools = subprocess.run([sys.executable, package.parent / "describe.py", top / "man"], input=described,
                           stdout=subprocess.PIPE, check=True).stdout
    files = {f"mr/{path.name}": path.read_bytes() for path in package.glob("*.py")}
    files.update({"mr/_tools.py": tools, "mr/py.typed": b""})
    places = {"bin": "data/scripts", "share/doc/mr": "dist-info/licenses"}  # all else where it is
    for folder in ["bin", "lib/mr", "share/doc/mr", *(f"share/man/man{n}" for n in (1, 5, 7))]:
        for path in (portable / folder).iterdir():
            files[f"mr_tools-{version}.{places.get(folder, f'data/data/{folder}')}/{path.name}"] = path.read_bytes()
    page = METADATA.format(version=version) + (package.parent / "README.md").read_text(encoding="utf-8")
    files[f"mr_tools-{version}.dist-info/METADATA"] = page.encode()
    return files


def main():
    version, portable, top, out = sys.argv[1], *map(pathlib.Path, sys.argv[2:])
    files = contents(version, portable, top)
    name = tag([*portable.glob("bin/*"), *portable.glob("lib/mr/*")])
    info = f"mr_tools-{version}.dist-info"
    files[f"{info}/WHEEL"] = WHEEL.format(version=version, tag=name).encode()
    record = "".join(f"{path},sha256={base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b'=').decode()},"
                     f"{len(data)}\n" for path, data in sorted(files.items()))
    when = time.gmtime(max(int(os.environ.get("SOURCE_DATE_EPOCH", time.time())), 315532800))[:6]
    wheel = out / f"mr_tools-{version}-{name}.whl"
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for path, data in [*sorted(files.items()), (f"{info}/RECORD", f"{record}{info}/RECORD,,\n".encode())]:
            entry = zipfile.ZipInfo(path, when)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = (0o100755 if "/scripts/" in path else 0o100644) << 16
            archive.writestr(entry, data)
    print(wheel)


if __name__ == "__main__":
    main()
