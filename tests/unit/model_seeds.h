/* model_seeds.h -- small models in every format, for tests that read, damage and write them. */
#ifndef MODEL_SEEDS_H
#define MODEL_SEEDS_H

#include "base/random.h"
#include "formats/format.h"

/* A surface with every attribute, its coordinates floats where `single`. */
static inline mr_model
make_model(mr_ctx *ctx, size_t nv, size_t nf, bool single)
{
	mr_random r = { nv + 7 * nf };
	mr_v3 *p = MR_NEW(ctx, nv, mr_v3), *normal = MR_NEW(ctx, nv, mr_v3);
	unsigned char *color = MR_NEW(ctx, 4 * nv, unsigned char);
	double *uv = MR_NEW(ctx, 2 * nv, double);
	mr_tri *t = MR_NEW(ctx, nf, mr_tri);
	uint32_t *group = MR_NEW(ctx, nf, uint32_t);
	static const char groups[] = "left leg\n\303\244rm\nhead";

	for (size_t i = 0; i < nv; i++) {
		p[i] = mr_vec(mr_random_real(&r) - 0.5, 1e5 * mr_random_real(&r), 1e-7 * mr_random_real(&r));
		normal[i] = mr_unit(mr_vec(mr_random_real(&r), mr_random_real(&r) - 0.5, mr_random_real(&r)));
		if (single) {
			p[i] = mr_vec(mr_as_float(p[i].x), mr_as_float(p[i].y), mr_as_float(p[i].z));
			normal[i] = mr_vec(
			    mr_as_float(normal[i].x), mr_as_float(normal[i].y), mr_as_float(normal[i].z));
		}
		for (size_t k = 0; k < 4; k++)
			color[4 * i + k] = (unsigned char)(k < 3 ? mr_random_bits(&r) : 255);
		for (size_t k = 0; k < 2; k++)
			uv[2 * i + k] = mr_as_float(mr_random_real(&r));
	}
	for (size_t f = 0; f < nf; f++) {
		for (int k = 0; k < 3; k++)
			t[f].v[k] = (uint32_t)((f + (size_t)k) % nv);
		group[f] = (uint32_t)(f < 3 ? f : 3 * f / nf);
	}
	return (mr_model){ .p = p,
		.nv = nv,
		.t = nf ? t : NULL,
		.nf = nf,
		.normal = normal,
		.color = color,
		.texcoord = uv,
		.group = nf ? group : NULL,
		.groups = { nf ? groups : NULL, nf ? sizeof groups - 1 : 0 } };
}

typedef struct seed {
	const char *format; /* NULL: to be recognised */
	const char *text;
	size_t bytes;  /* 0: of the text */
	size_t nv, nf; /* as they should be read */
} seed;

#define LE32(n)  (char)((n)&255), (char)((n) >> 8 & 255), (char)((n) >> 16 & 255), (char)((n) >> 24 & 255)
#define ZEROS16  0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0
#define REAL_ONE 0, 0, 0, 0, 0, 0, (char)0xf0, 0x3f

/* LAS 1.2, point format 2, two points: header of 227 bytes. */
static const char las_seed[227 + 2 * 26] = { 'L', 'A', 'S',
	'F', [24] = 1, [25] = 2, [94] = (char)227, [96] = (char)227, [104] = 2, [105] = 26, [107] = 2,
	[131] = REAL_ONE, [139] = REAL_ONE, [147] = REAL_ONE, [227] = LE32(10), LE32(20), LE32(30), [247] = 0,
	1, 0, 2, 0, 3, [253] = LE32(11), LE32(21), LE32(31) };

/* Little-endian, as some programs write it: one triangle, no number of colours. */
static const char off_seed[] = { 'O', 'F', 'F', ' ', 'B', 'I', 'N', 'A', 'R', 'Y', '\n', LE32(3), LE32(1),
	LE32(0), ZEROS16, LE32(0x3f800000), ZEROS16, LE32(3), LE32(0), LE32(1), LE32(2) };

static const char strips_seed[] =
    "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\nproperty "
    "float y\nproperty float z\nelement tristrips 1\nproperty list int int "
    "vertex_indices\nend_header\n"
    "\0\0\0\0\0\0\0\0\0\0\0\0"
    "\0\0\x80\x3f\0\0\0\0\0\0\0\0"
    "\0\0\0\0\0\0\x80\x3f\0\0\0\0"
    "\0\0\x80\x3f\0\0\x80\x3f\0\0\0\0"
    "\x08\0\0\0"
    "\0\0\0\0\x01\0\0\0\x02\0\0\0\x03\0\0\0\xff\xff\xff\xff\0\0\0\0\x01\0\0\0\x02\0\0";

static const char pcd_seed[] =
    "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 1\nHEIGHT 1\nDATA "
    "binary\n\0\0\x80\x3f\0\0\0\0\0\0\0";

/* Two points with a label, packed: a zero as it is, six more by it, and so on. */
static const char packed_seed[] =
    "VERSION .7\nFIELDS x y z label\nSIZE 4 4 4 2\nTYPE F F F U\nCOUNT 1 1 1 1\nWIDTH 2\nHEIGHT 1\n"
    "VIEWPOINT 1 2 3 1 0 0 0\nPOINTS 2\nDATA binary_compressed\n\x10\0\0\0\x1c\0\0\0"
    "\0\0\x60\0\x02\x80\x3f\0\xe0\x06\0\x03\x07\0\x09";

static const char gltf_seed[] =
    "{\"asset\":{\"version\":\"2.0\"},\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},"
    "\"mode\":5}]}],\"nodes\":[{\"mesh\":0,\"name\":\"a\"}],\"scenes\":[{\"nodes\":[0]}],\"buffers\":[{"
    "\"byteLength\":36,\"uri\":\"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}],"
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],\"accessors\":[{\"bufferView\":0,"
    "\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}]}";

static const seed seeds[] = {
	{ NULL, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", 0, 3, 1 },
	{ NULL,
	    "# a\n\no box\ng\nusemtl m\nv 0 0 0 1 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n"
	    "f 1/1/1 2/1/1 3//1 4\ng a b\nf -1/-1 -2// -3\nl 1 2 3\np 1\ns off\n",
	    0, 4, 3 },
	{ NULL,
	    "ply\nformat ascii 1.0\ncomment group a\nelement vertex 4\nproperty double x\nproperty float "
	    "y\nproperty "
	    "int z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nelement edge 1\nproperty "
	    "int "
	    "a\nproperty list uchar float b\nelement face 2\nproperty list uchar int "
	    "vertex_indices\nproperty uint "
	    "group\nend_header\n0 0 0 1 2 3\n1 0 0 4 5 6\n1 1 0 7 8 9\n0 1 0 10 11 12\n5 2 0.5 0.25\n4 0 1 2 "
	    "3 0\n3 0 "
	    "1 2 0\n",
	    0, 4, 3 },
	{ NULL,
	    "mtllib a b.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvn 0 0 1\nvn 0 1 0\no a\n"
	    "f 1/1/1 2/2/1 3/1/2 4\nusemtl m n\ns 2\nf 1/2 2/1 3/2\ng q\nusemtl\ns off\nf 1//1 3//2 4//1\n",
	    0, 4, 4 },
	{ NULL,
	    "ply\nformat ascii 1.0\ncomment mtllib a.mtl\ncomment material red\ncomment material blue\n"
	    "comment object o\nelement vertex 5\nproperty double x\nproperty float y\nproperty int z\n"
	    "property float quality\nproperty short t\nproperty uint label\nelement face 2\nproperty list "
	    "uchar "
	    "uint vertex_indices\nproperty list uchar float texcoord\nproperty list uchar double "
	    "corner_normal\nproperty uint material\nproperty uint object\nproperty uint smoothing\nproperty "
	    "uchar red\nend_header\n0 0 0 0.5 -1 7\n1 0 0 nan 0 8\n2 1 0 0 0 9\n1 2 0 0 0 0\n0 1 0 0 0 0\n"
	    "5 0 1 2 3 4 10 0 0 1 0 1 1 0 1 0.5 0.5 0 1 0 2 9\n"
	    "3 0 2 4 6 0 0 1 0 nan nan 9 0 0 1 0 0 1 0 1 0 0 0 0 8\n",
	    0, 5, 4 },
	{ NULL, strips_seed, sizeof strips_seed, 4, 3 },
	{ NULL,
	    "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
	    "0\nendloop\nendfacet\nendsolid a\nsolid\nfacet normal nan nan nan\nouter loop\nvertex -0 0 "
	    "0\nvertex 1 0 "
	    "0\nvertex 0 -1 0\nendloop\nendfacet\nendsolid\n",
	    0, 4, 2 },
	{ NULL, "# c\nOFF\n4 2 0\n0 0 0 # d\n1 0 0\n\n1 1 0\n0 1 0\n3 0 1 2 255 0 0\n3 0 2 3\n", 0, 4, 2 },
	{ NULL,
	    "STCNOFF\n3 1 0\n0 0 0 0 0 1 255 0 0 255 0 0\n1 0 0 0 0 1 0 255 0 255 1 0\n0 1 0 0 0 1 0 0 255 "
	    "255 0 1\n3 0 1 2\n",
	    0, 3, 1 },
	{ NULL, off_seed, sizeof off_seed, 3, 1 },
	{ NULL, "0 0 0\n1 0 0\n0 1 0\n", 0, 3, 0 },
	{ NULL, "2\n0 0 0 10 1 2 3\n1 0 0 20 4 5 6\n", 0, 2, 0 },
	{ NULL, "2\n0 0 0\n1 0 0\n0 0 1\n0 0 1\n", 0, 2, 0 },
	{ NULL, "\"X\",\"Y\",\"Z\",\"Time\"\n0,1,2,3\n4,5,6,7\n", 0, 2, 0 },
	{ NULL,
	    "2\n1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n1 2 3 0.5 1 2 3\n0 0 0 0 "
	    "0 0 0\n",
	    0, 2, 0 },
	{ NULL,
	    "# .PCD v.7\nVERSION .7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F U\nCOUNT 1 1 1 1\nWIDTH "
	    "2\nHEIGHT 1\nPOINTS "
	    "2\nDATA ascii\n0 0 0 16711680\nnan 0 0 1\n",
	    0, 2, 0 },
	{ NULL, pcd_seed, sizeof pcd_seed, 1, 0 },
	{ NULL, packed_seed, sizeof packed_seed, 2, 0 },
	{ NULL, las_seed, sizeof las_seed, 2, 0 },
	{ NULL, gltf_seed, 0, 3, 1 },
};

enum { SEEDS = sizeof seeds / sizeof *seeds };

static inline size_t
seed_size(const seed *s)
{
	return s->bytes ? s->bytes : strlen(s->text);
}

#endif
