"""Three levels of detail by Open3D: python3 peer_levels.py points|meshes IN OUT, to OUT.0.glb, OUT.1.glb, OUT.2.glb

Of points Poisson's surface of depth 8, normals estimated and oriented where there are none, cut 6 spacings from
points; of a mesh the mesh.  Then a quarter and a sixteenth of the faces by quadrics.  Prints the seconds
since the imports.
"""
import sys
import time

import numpy
import open3d


def surface(path):
    cloud = open3d.io.read_point_cloud(path)
    if not cloud.has_normals():
        cloud.estimate_normals(open3d.geometry.KDTreeSearchParamKNN(30))
        cloud.orient_normals_consistent_tangent_plane(30)
    mesh, _ = open3d.geometry.TriangleMesh.create_from_point_cloud_poisson(cloud, depth=8)
    distance = open3d.geometry.PointCloud(mesh.vertices).compute_point_cloud_distance(cloud)
    spacing = numpy.median(numpy.asarray(cloud.compute_nearest_neighbor_distance()))
    mesh.remove_vertices_by_mask(numpy.asarray(distance) > 6 * spacing)
    return mesh


def main(kind, path, out):
    began = time.monotonic()
    mesh = surface(path) if kind == "points" else open3d.io.read_triangle_mesh(path)
    faces = len(mesh.triangles)
    for level in range(3):
        coarse = mesh.simplify_quadric_decimation(faces >> 2 * level) if level else mesh
        coarse.compute_vertex_normals()
        open3d.io.write_triangle_mesh("%s.%d.glb" % (out, level), coarse)
    print(time.monotonic() - began)


main(*sys.argv[1:])
