"""peers -- from raw scans and models to one GLB with levels of detail, by a pipe of ours and by Open3D; usage:
peers.py FOLDER

FOLDER gets index.html: time, memory, distances, normals and failures of each, with pictures.  Of a cloud the job is
surface, three levels, GLB; of a model it is repair, a quarter and a sixteenth of the faces, GLB with what the model
has.  Distances are in the mean, to and from the input, as shares of the diagonal; normals are degrees off.
The peer's seconds are without the start of Python; memory is that of the largest process.
Knobs: DATA, MODELS (parts of names).
"""
import html
import json
import math
import os
import subprocess
import sys
import time

CLOUDS = ("ball.ply.gz bunnyData.pts.gz cube.pwn.gz elephant.pwn.gz hippo1.ply kitten.xyz.gz oni.pwn spheres.ply "
          "blobby.xyz sphere_20k.xyz.gz").split()
MODELS = ("spot.obj.gz camel_b.obj pirate.obj.gz fuze.obj chair_model.obj.gz igea.ply.gz nefertiti.obj.gz "
          "dragon_vrip_res2.ply.gz quadknot.obj b9_mesh.off.gz").split()
SCAN = ("mr-import -q --points '{0}' | mr-shrinkwrap -q | mr-simplify -q | mr-fit -q | mr-sample -q -o s.mrs && "
        "{{ mr-decode -q s.mrs -o 0.mrs; mr-decode -q --level 1 s.mrs -o 1.mrs; mr-decode -q --level 0 s.mrs -o 2.mrs; "
        "mr-cat 0.mrs 1.mrs 2.mrs; }} | mr-export -q --lods mr.glb")
MODEL = ("mr-import -q --repair '{0}' -o 0.mrs && mr-simplify -q -r 0.25 0.mrs -o 1.mrs && "
         "mr-simplify -q -r 0.25 1.mrs -o 2.mrs && mr-cat 0.mrs 1.mrs 2.mrs | mr-export -q --lods mr.glb")
HERE = os.path.dirname(os.path.abspath(__file__))


def run(command, limit=300):
    """Seconds, bytes of the largest process, and whether it failed."""
    began = time.monotonic()
    child = subprocess.Popen(["timeout", str(limit), "sh", "-c", command], stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL)
    _, status, used = os.wait4(child.pid, 0)
    child.returncode = 0
    return time.monotonic() - began, 1024 * used.ru_maxrss, status != 0


def told(command):
    """The first line of JSON that a command prints; {} of one that fails."""
    out = subprocess.run(command, shell=True, capture_output=True, text=True, check=False).stdout.splitlines()
    return json.loads(out[0]) if out else {}


def judge(who, levels, source):
    """Distances and normals of the finest and the coarsest level, faces, attributes; a picture of both."""
    row = {"bytes": sum(os.path.getsize(f) for f in os.listdir(".") if f.startswith(who) and f.endswith(".glb"))}
    for name, level in zip(("fine", "coarse"), (levels[0], levels[-1])):
        layer = "points" if source == "points" else "mesh"
        said = told(f"mr-compare -q --json -a {layer} -b mesh source.mrs {level}")
        both = said.get("a_to_b_relative" if layer == "points" else "both_relative", {})
        row[name] = both.get("mean"), said.get("both", {}).get("normal_mean")
        shape = told(f"mr-info -q --json --no-intersections {level}").get("layers", {}).get("mesh", {})
        row[name + "_faces"] = shape.get("faces")
        row["sound"] = bool(row.get("sound", True) and shape.get("manifold") and shape.get("oriented"))
        row["has"] = sorted({"color", "corner_texcoord", "texcoord", "material"} & set(shape.get("columns", {})))
    run(f"mr-cat {levels[0]} {levels[-1]} | mr-render -q --sheet --columns 2 --no-labels --size 220x200 -l mesh "
        f"- {who}.png")
    return row


def ours(path, kind):
    seconds, most, failed = run((SCAN if kind == "points" else MODEL).format(path))
    row = {"seconds": seconds, "bytes_of_memory": most, "failed": failed}
    return row if failed else {**row, **judge("mr", ["0.mrs", "1.mrs", "2.mrs"], kind)}


def peers(kind, python):
    run("mr-export -q source.mrs in.ply")
    _, most, failed = run(f"OMP_NUM_THREADS=2 '{python}' '{HERE}/peer_levels.py' {kind} in.ply peer >seconds")
    if failed:
        return {"seconds": math.nan, "bytes_of_memory": most, "failed": failed}
    with open("seconds", encoding="ascii") as file:
        row = {"seconds": float(file.read()), "bytes_of_memory": most, "failed": failed}
    for level in range(3):
        run(f"mr-import -q peer.{level}.glb -o p{level}.mrs")
    return {**row, **judge("peer", ["p0.mrs", "p1.mrs", "p2.mrs"], kind)}


def cell(row, name, share=100):
    mean, normals = row.get(name) or (None, None)
    if mean is None:
        return "<td>-"
    return f"<td>{share * mean:.3g} %" + (f", {normals:.3g}°" if normals is not None else "")


def page(rows):
    yield ("<!doctype html><meta charset=utf-8><meta name=viewport content='width=device-width'><title>mr beside Open3D"
           "</title><style>body{font:15px/1.4 sans-serif;margin:2em;color-scheme:light dark}td,th{padding:.2em .7em;"
           "text-align:left;vertical-align:top}img{width:330px;max-width:90vw}tr+tr{border-top:1px solid #8885}</style>"
           "<h1>From raw input to one file with levels of detail</h1><p>" + html.escape(__doc__.split("\n\n")[1]))
    yield ("<table><tr><th>input<th>who<th>seconds<th>memory<th>finest: distance, normals<th>faces<th>coarsest<th>faces"
           "<th>kB<th>has<th>finest and coarsest level")
    for name, who, row in rows:
        yield f"<tr><td>{html.escape(name)}<td>{who}<td>{row['seconds']:.2f}<td>{row['bytes_of_memory'] / 1e6:.0f} MB"
        if row["failed"]:
            yield "<td colspan=7>failed"
            continue
        yield cell(row, "fine") + f"<td>{row['fine_faces']}" + cell(row, "coarse") + f"<td>{row['coarse_faces']}"
        sound = "" if row["sound"] else " (no oriented manifold)"
        yield f"<td>{row['bytes'] / 1e3:.0f}<td>{', '.join(row['has'])}{sound}"
        yield f"<td><img loading=lazy src='{html.escape(name)}/{who}.png'>"
    yield "</table>"


def tell(name, who, row):
    """Lines for tests/bench/run."""
    if row["failed"]:
        print(name, who, "failed", flush=True)
        return
    for what, value, unit in (("seconds", row["seconds"], "s"), ("memory", row["bytes_of_memory"] / 1e6, "MB"),
            ("finest", 100 * (row["fine"][0] or 0), "%"), ("coarsest", 100 * (row["coarse"][0] or 0), "%")):
        print(f"{name}-{what} {who} {value:.4g} {unit}", flush=True)


def main(folder):
    data, parts = os.environ["DATA"], os.environ.get("MODELS", "").split()
    python = next((p for p in (sys.executable, "/usr/bin/python3")
        if run(f"'{p}' -c 'import open3d'")[2] is False), None)
    rows = []
    for kind, names in ("points", CLOUDS), ("meshes", MODELS):
        for name in names:
            path = os.path.join(data, kind, name)
            if not os.path.exists(path) or parts and not any(part in name for part in parts):
                print(name, "is not there" if not parts else "left out", file=sys.stderr)
                continue
            os.makedirs(os.path.join(folder, name), exist_ok=True)
            os.chdir(os.path.join(folder, name))
            run(f"mr-import -q {'--points' if kind == 'points' else ''} '{path}' -o source.mrs")
            for who, row in ("mr", ours(path, kind)), ("peer", peers(kind, python) if python else None):
                if row:
                    rows.append((name, who, row))
                    tell(name, who, row)
            for file in os.listdir("."):
                if not file.endswith(".png"):
                    os.remove(file)
    with open(os.path.join(folder, "index.html"), "w", encoding="utf-8") as file:
        file.write("\n".join(page(rows)))


main(os.path.abspath(sys.argv[1]))
