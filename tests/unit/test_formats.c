/* Formats: what is written is read back bit for bit; what is read is what the file says; gzip; names. */
#include "model_seeds.h"

#include "formats/model.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <unistd.h>

#include <cmocka.h>

enum { N = 1, C = 2, T = 4, G = 8, F = 16 }; /* what a format keeps */

static const struct {
	const char *format, *path;
	unsigned keeps;
} written[] = {
	{ NULL, "m.obj", N | C | T | G | F },
	{ NULL, "m.ply", N | C | T | F },
	{ "ply-ascii", "m.ply", N | C | T | F },
	{ NULL, "m.off", N | C | T | F },
	{ NULL, "m.xyz", N | C },
	{ NULL, "m.pts", C },
	{ NULL, "m.pwn", N },
	{ NULL, "m.obj.gz", N | C | T | G | F },
	{ NULL, "m.ply.gz", N | C | T | F },
	{ NULL, "m.pts.gz", C },
};

static void
ok(mr_ctx *ctx, mr_status status)
{
	if (status < 0)
		print_message("# %s\n", ctx->error);
	assert_int_equal(status, MR_OK);
}

static mr_model
restrict_to(mr_model m, unsigned keeps)
{
	if (!(keeps & N))
		m.normal = NULL;
	if (!(keeps & C))
		m.color = NULL;
	if (!(keeps & T))
		m.texcoord = NULL;
	if (!(keeps & G))
		m.group = NULL;
	if (!(keeps & F))
		m.nf = 0;
	return m;
}

/* Name i of a list. */
static size_t
line_of(mr_lines l, uint32_t i, const char **name)
{
	const char *p = l.text, *end = p + l.bytes, *e;

	for (; i > 0; i--)
		p = (const char *)memchr(p, '\n', (size_t)(end - p)) + 1;
	e = memchr(p, '\n', (size_t)(end - p));
	*name = p;
	return (size_t)((e ? e : end) - p);
}

/* The name of face f's group. */
static size_t
group_name(const mr_model *m, size_t f, const char **name)
{
	return line_of(m->groups, m->group[f], name);
}

static void
same_names(const uint32_t *a, mr_lines in_a, const uint32_t *b, mr_lines in_b, size_t nf)
{
	assert_true(!a == !b);
	for (size_t f = 0; a && f < nf; f++) {
		const char *x, *y;
		size_t n = line_of(in_a, a[f], &x);
		assert_int_equal(line_of(in_b, b[f], &y), n);
		assert_memory_equal(x, y, n);
	}
}

static void
same_rows(const void *a, const void *b, size_t bytes)
{
	if (bytes == 0)
		return;
	assert_true(!a == !b);
	if (a)
		assert_memory_equal(a, b, bytes);
}

static void
same_properties(const mr_model *a, const mr_model *b)
{
	assert_int_equal(a->properties, b->properties);
	for (size_t i = 0; i < a->properties; i++) {
		const mr_property *p = &a->property[i], *q = &b->property[i];
		assert_string_equal(p->name, q->name);
		assert_memory_equal(&p->shape, &q->shape, sizeof p->shape);
		same_rows(p->data, q->data,
		    (p->shape.element == 'f' ? a->nf : a->nv) * mr_type_size(p->shape.type));
	}
}

static void
same_model(const mr_model *a, const mr_model *b)
{
	assert_int_equal(a->nv, b->nv);
	assert_int_equal(a->nf, b->nf);
	assert_memory_equal(a->p, b->p, a->nv * sizeof *a->p);
	same_rows(a->t, b->t, a->nf * sizeof *a->t);
	same_rows(a->normal, b->normal, a->nv * sizeof *a->normal);
	same_rows(a->color, b->color, 4 * a->nv);
	same_rows(a->texcoord, b->texcoord, 2 * a->nv * sizeof(double));
	same_rows(a->corner_texcoord, b->corner_texcoord, 6 * a->nf * sizeof(double));
	same_rows(a->corner_normal, b->corner_normal, 3 * a->nf * sizeof(mr_v3));
	same_rows(a->smoothing, b->smoothing, a->nf * sizeof *a->smoothing);
	same_rows(a->polygon, b->polygon, a->nf * sizeof *a->polygon);
	same_names(a->group, a->groups, b->group, b->groups, a->nf);
	same_names(a->object, a->objects, b->object, b->objects, a->nf);
	same_names(a->material, a->materials, b->material, b->materials, a->nf);
	assert_int_equal(a->mtllib.bytes, b->mtllib.bytes);
	same_rows(a->mtllib.text, b->mtllib.text, a->mtllib.bytes);
	same_properties(a, b);
}

/* Every set of attributes that the format keeps goes out and comes back. */
static void
round_trips(void **state)
{
	(void)state;
	for (size_t i = 0; i < sizeof written / sizeof *written; i++)
		for (unsigned with = 0; with < 32; with++) {
			mr_ctx ctx;
			mr_model m, back;
			unsigned keeps = written[i].keeps;
			if ((with & keeps) != with || ((with & (T | G)) && !(with & F)) ||
			    (strstr(written[i].path, "pwn") && !(with & N)))
				continue;
			mr_ctx_init(&ctx, 1);
			m = restrict_to(make_model(&ctx, 40, 60, false), with);
			ok(&ctx, mr_model_write(&ctx, written[i].path, written[i].format, &m, NULL));
			ok(&ctx, mr_model_read(&ctx, written[i].path, NULL, &back));
			same_model(&m, &back);
			mr_ctx_free(&ctx);
		}
}

static mr_status
parse(mr_ctx *ctx, const char *path, const char *text, mr_model *m)
{
	return mr_model_parse(ctx, path, NULL, (const unsigned char *)text, strlen(text), m);
}

/* A random OBJ: polygons of some corners, seams, creases, corners without, relative indices, and marks that
 * change. */
static char *
random_obj(mr_ctx *ctx, uint64_t number)
{
	enum { CORNERS = 30, ROOM = 1 << 16 };
	mr_random r = { number };
	char *text = MR_NEW(ctx, ROOM, char);
	size_t n = 0;

#define SAY(...) (n += (size_t)snprintf(text + n, ROOM - n, __VA_ARGS__))
	SAY("mtllib a b.mtl\nmtllib c.mtl\n");
	for (int i = 0; i < CORNERS; i++) {
		SAY("v %.17g %.17g %.17g\n", cos(i * 2 * MR_PI / CORNERS) * (i % 3 ? 1 : 0.3),
		    sin(i * 2 * MR_PI / CORNERS), 1e-3 * mr_random_real(&r));
		SAY("vt %.17g %.17g\nvn 0 %.17g 1\n", mr_random_real(&r), mr_random_real(&r),
		    mr_random_real(&r));
	}
	for (int f = 0; f < 40; f++) {
		int corners = 3 + (int)(mr_random_bits(&r) % 5), first = (int)(mr_random_bits(&r) % CORNERS);
		bool uv = mr_random_bits(&r) % 8, vn = mr_random_bits(&r) % 8;
		int last = f % 4 == 1 ? CORNERS + 1 : 0;
		if (mr_random_bits(&r) % 3 == 0)
			SAY("%s %s%d\n", (const char *[]){ "o", "g", "usemtl" }[f % 3], f % 2 ? "a b" : "c",
			    f % 5);
		if (f % 7 == 3)
			SAY(f % 2 ? "s off\n" : "s %d\n", f);
		SAY("f");
		for (int k = 0; k < corners; k++) {
			int v = (first + k * 3) % CORNERS + 1, t = 1 + (int)(mr_random_bits(&r) % CORNERS);
			SAY(uv   ? vn ? " %d/%d/%d" : " %d/%d"
			    : vn ? " %d//%d"
				 : " %d",
			    v - last, (uv ? t : v / 4 + 1) - last, v / 4 + 1 - last);
		}
		SAY("\n");
	}
#undef SAY
	assert_true(n < ROOM);
	return text;
}

/* All that OBJ knows of goes out and comes back. */
static void
whole_models(void **state)
{
	(void)state;
	for (uint64_t number = 1; number < 40; number++) {
		mr_ctx ctx;
		mr_model m, back;
		mr_ctx_init(&ctx, 1);
		ok(&ctx, parse(&ctx, "", random_obj(&ctx, number), &m));
		assert_true(m.corner_texcoord && m.corner_normal && m.object && m.group && m.material &&
			    m.smoothing && m.polygon && m.mtllib.bytes == 13);
		ok(&ctx, mr_model_write(&ctx, "whole.obj", NULL, &m, NULL));
		ok(&ctx, mr_model_read(&ctx, "whole.obj", NULL, &back));
		same_model(&m, &back);
		mr_ctx_free(&ctx);
	}
}

/* The text with a comment behind each line, so that it is several blocks to the reader. */
static char *
stretched(mr_ctx *ctx, const char *text)
{
	enum { MORE = 1000 };
	size_t lines = 0;
	char *to, *all;

	for (const char *p = text; *p; p++)
		lines += *p == '\n';
	to = all = MR_NEW(ctx, strlen(text) + MORE * lines + 1, char);
	for (; *text; text++) {
		*to++ = *text;
		if (*text != '\n')
			continue;
		memset(to, '#', MORE);
		to += MORE;
		to[-1] = '\n';
	}
	*to = 0;
	return all;
}

/* Blocks of an OBJ, read by several threads, are one model; what is wrong in the last has its line. */
static void
blocks(void **state)
{
	(void)state;
	for (uint64_t number = 1; number < 10; number++) {
		mr_ctx ctx;
		mr_model one, several;
		char *text;
		mr_ctx_init(&ctx, 4);
		text = random_obj(&ctx, number);
		ok(&ctx, parse(&ctx, "", text, &one));
		text = stretched(&ctx, text);
		assert_true(strlen(text) > 1 << 17);
		ok(&ctx, parse(&ctx, "", text, &several));
		same_model(&one, &several);
		text = stretched(&ctx, mr_format(&ctx, "%sf 1 2 -31\nf 1 2 x\n", random_obj(&ctx, number)));
		assert_int_equal(parse(&ctx, "", text, &several), MR_EFORMAT);
		assert_non_null(strstr(ctx.error, ": vertex -31 of 30"));
		mr_ctx_free(&ctx);
	}
}

/* Properties of every type, of vertices and faces, and of a quad's triangles; as columns and back. */
static void
properties(void **state)
{
	static const char head[] =
	    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
	    "z\nproperty float quality\nproperty int label\nproperty uchar flag\nproperty ushort "
	    "wide\nproperty char c\nproperty short s2\nproperty uint u4\nproperty double d8\nproperty float "
	    "region\nproperty float a_name_of_just_24_bytes_\nproperty float nx\nelement face "
	    "2\nproperty "
	    "list uchar int vertex_indices\nproperty float quality\nproperty uchar red\nend_header\n"
	    "0 0 0 0.1 -1 255 65535 -128 -32768 4294967295 1e-300 0.5 7 1\n"
	    "1 0 0 nan 2 0 1 127 32767 0 0.1 1 8 2\n1 1 0 1 3 0 1 0 0 0 0 2 9 3\n0 1 0 1 4 0 1 0 0 0 0 3 10 "
	    "4\n"
	    "4 0 1 2 3 0.25 200\n3 0 1 2 0.75 100\n";
	static const char *const names[] = { "quality", "label", "flag", "wide", "c", "s2", "u4", "d8",
		"region", "a_name_of_just_24_bytes_", "nx", "quality", "red" };
	static const char *const columns[] = { "quality", "label", "flag", "wide", "c", "s2", "u4", "d8",
		"ply_region", "a_name_of_just_24_bytes_", "ply_nx", "ply_quality", "red" };
	static const char *const formats[] = { "ply-ascii", "ply" };
	mr_model m, back;
	mr_frame *f;
	mr_ctx ctx;

	(void)state;
	mr_ctx_init(&ctx, 1);
	ok(&ctx, parse(&ctx, "", head, &m));
	assert_int_equal(m.properties, 13);
	for (size_t i = 0; i < 13; i++)
		assert_string_equal(m.property[i].name, names[i]);
	assert_int_equal(((const uint32_t *)m.property[6].data)[0], 4294967295u);
	assert_true(((const double *)m.property[11].data)[1] == 0.25); /* the quad's second triangle */
	assert_int_equal(((const unsigned char *)m.property[12].data)[2], 100);

	ok(&ctx, mr_frame_new(&ctx, "test", &f));
	ok(&ctx, mr_model_put(&ctx, f, NULL, &m));
	for (size_t i = 0; i < 13; i++)
		assert_true(mr_layer_has(f, "mesh", columns[i]));
	ok(&ctx, mr_model_get(&ctx, f, "mesh", &back));
	same_model(&m, &back);
	for (int i = 0; i < 2; i++) {
		mr_model again;
		ok(&ctx, mr_model_write(&ctx, "properties.ply", formats[i], &m, NULL));
		ok(&ctx, mr_model_read(&ctx, "properties.ply", NULL, &again));
		if (i == 0)
			same_model(&m, &again);
		assert_memory_equal(again.property[1].data, m.property[1].data, 4 * sizeof(double));
		assert_memory_equal(again.property[5].data, m.property[5].data, 4 * sizeof(double));
	}
	mr_ctx_free(&ctx);
}

/* STL keeps triangles in their order, each corner where it was; equal corners are one vertex. */
static void
stl_round_trip(void **state)
{
	(void)state;
	for (int ascii = 0; ascii < 2; ascii++) {
		mr_ctx ctx;
		mr_model m, back;
		mr_ctx_init(&ctx, 1);
		m = make_model(&ctx, 40, 60, !ascii);
		ok(&ctx, mr_model_write(&ctx, "m.stl", ascii ? "stl-ascii" : NULL, &m, NULL));
		ok(&ctx, mr_model_read(&ctx, "m.stl", NULL, &back));
		assert_int_equal(back.nf, m.nf);
		assert_int_equal(back.nv, m.nv);
		for (size_t f = 0; f < m.nf; f++)
			for (int k = 0; k < 3; k++)
				assert_memory_equal(
				    &m.p[m.t[f].v[k]], &back.p[back.t[f].v[k]], sizeof(mr_v3));
		mr_ctx_free(&ctx);
	}
}

/* The sentence holds `part`, and the model is not touched. */
static void
refused(const char *path, const char *text, const char *part)
{
	mr_ctx ctx;
	mr_model m = { .nv = 4711 };

	mr_ctx_init(&ctx, 1);
	assert_true(parse(&ctx, path, text, &m) < 0);
	if (!strstr(ctx.error, part))
		print_message("# '%s' lacks '%s'\n", ctx.error, part);
	assert_non_null(strstr(ctx.error, part));
	assert_int_equal(m.nv, 4711);
	mr_ctx_free(&ctx);
}

static void
recognised(void **state)
{
	(void)state;
	for (size_t i = 0; i < SEEDS; i++) {
		mr_ctx ctx;
		mr_model m;
		mr_ctx_init(&ctx, 1);
		ok(&ctx, mr_model_parse(
			     &ctx, "", NULL, (const unsigned char *)seeds[i].text, seed_size(&seeds[i]), &m));
		if (m.nv != seeds[i].nv || m.nf != seeds[i].nf)
			print_message("# seed %zu: %zu %zu\n", i, m.nv, m.nf);
		assert_int_equal(m.nv, seeds[i].nv);
		assert_int_equal(m.nf, seeds[i].nf);
		mr_ctx_free(&ctx);
	}
}

#define TRIANGLE "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
#define PLY      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
#define FACE     "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
#define SOLID    "solid a\nfacet normal 0 0 1\nouter loop\n"

static void
refusals(void **state)
{
	(void)state;
	refused("", "", "the file is empty");
	refused("", "hello world\n", "no format is recognised");
	refused("a.obj", "# nothing\n", "obj without a vertex");
	refused("", TRIANGLE "f 1 2 4\n", "line 4: vertex 4 of 3");
	refused("", TRIANGLE "f 1 2 -4\n", "line 4: vertex -4 of 3");
	refused("", TRIANGLE "f 1 2 0\n", "line 4: '0' is not a corner");
	refused("", TRIANGLE "f 1 2 x\n", "line 4: 'x' is not a corner");
	refused("", TRIANGLE "f 1 2 3/0\n", "line 4: '3/0' is not a corner");
	refused("", TRIANGLE "f 1 2 4294967299\n", "line 4: '4294967299' is not a corner");
	refused("", TRIANGLE "f 1 2 1,5\n", "line 4: '1,5' is not a corner");
	refused("", TRIANGLE "f 1 2\n", "none of the 1 faces has three corners");
	refused("", "v 0 0\n", "line 1: a vertex has 2 numbers");
	refused("", "v 0 0 0\nv 1,5 0 0\n", "line 2: a vertex is '1,5', not a number");
	refused("", "v nan 0 0\nv 0 -inf 0\n", "none of 2 points has a place");
	refused("", "v 0 0 0\n\n?foo 1 2\n", "line 3: '?foo' begins no statement of OBJ");
	refused("", PLY FACE "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "line 13: vertex 3 of 3");
	refused("", PLY FACE "0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", "line 13: vertex -1 of 3");
	refused("", PLY FACE "0 0 0\n1 0 0\n0 1 0\n3 0 1\n", "line 14: ");
	refused("",
	    PLY "element face 3000000000\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 "
		"0\n0 1 0\n",
	    "3000000000 rows of element face cannot be in the");
	refused("",
	    "ply\nformat ascii 1.0\nelement vertex 99999999999999\nproperty float x\nproperty float "
	    "y\nproperty float "
	    "z\nend_header\n0 0 0\n",
	    "rows of element vertex cannot be in the 6 bytes");
	refused("", "ply\nformat ascii 2.0\n", "line 2: the format's version is not 1.0");
	refused("", "ply\nformat ascii 1.0\nelement vertex 1\nproperty foo x\n",
	    "line 4: 'foo' is no type of PLY");
	refused("", PLY, "the header has no end_header");
	refused("", SOLID "vertex 0 0 0\nvertex 1 0 0\nendloop\nendfacet\nendsolid\n",
	    "line 6: a facet of 2 vertices");
	refused(
	    "", SOLID "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n", "the file ends inside a solid");
	refused("", SOLID "facet\n", "line 5: the file ends inside a solid");
	refused("", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "line 6: vertex 3 of 3");
	refused("", "OFF\n3 1 0\n0.000 0.000 0.000\n1.000 0.000 0.000\n", "line 5: a coordinate is missing");
	refused("", "OFF\n999999999 1 0\n0 0 0\n", "line 2: 999999999 vertices and 1 faces cannot be");
	refused("", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4000000 0 1 2\n", "line 6: a face of 4000000 corners");
	refused("", "OFF BINARY\nabcdefghijklmnop", "byte 23: ");
	refused("", "0 0 0\n1 2\n", "line 2: 2 columns, where line 1 has 3");
	refused("", "0 0 0\n1 2 x\n", "line 2: column 3 is 'x', not a number");
	refused("", "5\n0 0 0\n1 2 3\n", "ends after 2 of 5 points");
}

/* What stands in a file beside positions and faces. */
static void
details(void **state)
{
	mr_ctx ctx;
	mr_model m;
	const char *name;
	size_t n;

	(void)state;
	mr_ctx_init(&ctx, 1);
	ok(&ctx, parse(&ctx, "", "\357\273\277v 0 0 0 1 0.5 0\r\nv 1 0 0 0 0 1\nv 0 1 0 0 0 0\nf 1 2 3\n",
		     &m)); /* BOM, CR LF */
	assert_memory_equal(m.color, "\377\200\0\377\0\0\377\377\0\0\0\377", 12);
	ok(&ctx, parse(&ctx, "", TRIANGLE "g a  b\nf 1 2 3\ng\nf 3 2 1\n", &m));
	n = group_name(&m, 0, &name);
	assert_true(n == 4 && !memcmp(name, "a  b", 4));
	n = group_name(&m, 1, &name);
	assert_true(n == 7 && !memcmp(name, "default", 7));
	ok(&ctx,
	    parse(&ctx, "", TRIANGLE "vt 0 0\nvt 1 0\nvt 0 1\nvt 9 9\nf 1/1 2/2 3/3\nf 3/4 2/2 1/1\n", &m));
	assert_null(m.texcoord); /* a seam */
	assert_true(m.corner_texcoord[5] == 1 && m.corner_texcoord[6] == 9);
	assert_int_equal(m.nv, 3);
	ok(&ctx, parse(&ctx, "", TRIANGLE "vn 0 0 1\nvn 0 1 0\nf 1//1 2//1 3//1\nf 3//2 2//2 1//2\n", &m));
	assert_null(m.normal); /* several at a vertex */
	assert_true(m.corner_normal[2].z == 1 && m.corner_normal[3].y == 1);
	ok(&ctx, parse(&ctx, "", TRIANGLE "vn 0 0 1\nf 1//1 2//1 3//1\n", &m));
	assert_true(m.normal[2].z == 1);
	ok(&ctx, parse(&ctx, "", TRIANGLE "f 1// 2// 3//\nf 1/ 2/ 3/\n", &m));
	assert_int_equal(m.nf, 2);
	ok(&ctx, parse(&ctx, "", "1 2 3 10 20 30\n4 5 6 255 0 7\n", &m));
	assert_memory_equal(m.color, "\12\24\36\377\377\0\7\377", 8);
	assert_null(m.normal);
	ok(&ctx, parse(&ctx, "", "1 2 3 0 0 1\n4 5 6 0 1 0\n", &m));
	assert_null(m.color);
	assert_true(m.normal[0].z == 1);
	ok(&ctx, parse(&ctx, "", "1 2 3 0 0 0\n4 5 6 0 0 0\n", &m));
	assert_null(m.normal); /* all zero: not known */
	mr_ctx_free(&ctx);
}

/* Faces of a quad and of a polygon with a repeated corner; a triangle with one stays. */
static void
polygons(void **state)
{
	mr_ctx ctx;
	mr_model m;

	(void)state;
	mr_ctx_init(&ctx, 1);
	ok(&ctx, parse(&ctx, "", TRIANGLE "v 1 1 0\nf 1 2 4 3\nf 1 2 2\nf 1 2 2 4\nf 1 2\n", &m));
	assert_int_equal(m.nf, 4);
	mr_ctx_free(&ctx);
}

static void
put_file(const char *path, const char *text)
{
	FILE *f = fopen(path, "w");

	assert_non_null(f);
	assert_true(fputs(text, f) >= 0);
	assert_int_equal(fclose(f), 0);
}

/* How much was found of each kind. */
typedef struct heard {
	size_t count[MR_FINDING_KINDS];
} heard;

static void
hear(void *user, const mr_finding *f)
{
	((heard *)user)->count[f->kind] += f->count;
}

/* What an import could not keep, or had to mend, is found. */
static void
what_was_lost(void **state)
{
	mr_import_opts o = MR_IMPORT_DEFAULTS;
	mr_import_result r;
	heard h = { 0 };
	mr_frame *f;
	mr_ctx ctx;

	(void)state;
	mr_ctx_init(&ctx, 1);
	ctx.listener = (mr_listener){ .found = hear, .user = &h };
	put_file("lost.obj", TRIANGLE "v 1 1 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvn 0 0 1\nvn 0 1 0\n"
				      "f 1/1/1 2/2/1 4/2/1 3/1/1\nf 3/2/2 5/1/2 4/1/2\nf 1 2\nf 1 2 2\n");
	ok(&ctx, mr_import(&ctx, "lost.obj", &o, &f, &r));
	assert_int_equal(r.vertices, 5);
	assert_int_equal(r.triangles, 4);
	assert_int_equal(r.polygons, 1);
	assert_int_equal(r.seam_vertices, 2);
	assert_int_equal(r.crease_vertices, 2);
	assert_int_equal(h.count[MR_LOST], 1); /* a face of two corners */
	assert_int_equal(h.count[MR_REPAIRED], 0);

	h = (heard){ 0 };
	o.welds = o.repair = true;
	ok(&ctx, mr_import(&ctx, "lost.obj", &o, &f, &r));
	assert_int_equal(h.count[MR_LOST], 2);     /* and one that collapses */
	assert_int_equal(h.count[MR_REPAIRED], 2); /* vertices joined, a degenerate face */
	assert_int_equal(r.vertices, 4);
	assert_int_equal(r.triangles, 2);
	assert_int_equal(r.seam_vertices, 2); /* of the file */

	r.vertices = 4711;
	put_file("bad.obj", TRIANGLE "f 1 2 4\n");
	assert_int_equal(mr_import(&ctx, "bad.obj", NULL, &f, &r), MR_EFORMAT);
	assert_int_equal(r.vertices, 4711);
	mr_ctx_free(&ctx);
}

/* What the format of an export has no place for, or rounds, is found. */
static void
what_was_rounded(void **state)
{
	heard h = { 0 };
	mr_frame *f;
	mr_ctx ctx;

	(void)state;
	mr_ctx_init(&ctx, 1);
	put_file("fine.obj", "v 10000.1 0 0 1 0 0\nv 10001 0 0 0 1 0\nv 10000 0.3 0 0 0 1\nf 1 2 3\n");
	ok(&ctx, mr_import(&ctx, "fine.obj", NULL, &f, NULL));
	ctx.listener = (mr_listener){ .found = hear, .user = &h };
	ok(&ctx, mr_export(&ctx, f, NULL, "floats.stl", NULL));
	assert_int_equal(h.count[MR_ROUNDED], 2);
	assert_int_equal(h.count[MR_LOST], 3);
	h = (heard){ 0 };
	ok(&ctx, mr_export(&ctx, f, NULL, "points.pts", NULL));
	assert_int_equal(h.count[MR_ROUNDED], 0);
	assert_int_equal(h.count[MR_LOST], 1);
	ok(&ctx, mr_import(&ctx, "floats.stl", NULL, &f, NULL));
	h = (heard){ 0 };
	ok(&ctx, mr_export(&ctx, f, NULL, "again.stl", NULL));
	assert_int_equal(h.count[MR_ROUNDED], 0); /* they are floats already */
	assert_int_equal(mr_export(&ctx, f, NULL, "no/such/folder/a.pts", NULL), MR_EIO);
	mr_ctx_free(&ctx);
}

static void
names(void **state)
{
	static const struct {
		const char *path, *stem;
	} cases[] = { { "bunny.ply", "bunny" }, { "/a/b.c/bunny.ply.gz", "bunny" }, { "-", "stdin" },
		{ "a.b.obj", "a.b" }, { "noext", "noext" }, { ".hidden", ".hidden" }, { "x\ny.obj", "x_y" },
		{ "\377.obj", "_" } };
	mr_ctx ctx;
	bool binary;

	(void)state;
	mr_ctx_init(&ctx, 1);
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
		assert_string_equal(mr_format_stem(&ctx, cases[i].path), cases[i].stem);
	assert_int_equal(mr_format_check(&ctx, "a.foo", NULL, true, &binary), MR_EUSAGE);
	assert_int_equal(mr_format_check(&ctx, "a.obj", "foo", true, &binary), MR_EUSAGE);
	assert_int_equal(mr_format_check(&ctx, "a.las", NULL, true, &binary), MR_EUSAGE);
	assert_int_equal(mr_format_check(&ctx, "-", "ply", true, &binary), MR_OK);
	assert_true(binary);
	assert_int_equal(mr_format_check(&ctx, "A.OBJ", NULL, true, &binary), MR_OK);
	assert_false(binary);
	mr_ctx_free(&ctx);
}

/* A failure leaves the old file as it was, and no other. */
static void
whole_or_not(void **state)
{
	mr_ctx ctx;
	mr_model m, none, back;

	(void)state;
	mr_ctx_init(&ctx, 1);
	m = make_model(&ctx, 10, 10, false);
	none = restrict_to(m, 0);
	ok(&ctx, mr_model_write(&ctx, "old.pwn", NULL, &m, NULL));
	assert_int_equal(mr_model_write(&ctx, "old.pwn", NULL, &none, NULL), MR_EMISSING);
	ok(&ctx, mr_model_read(&ctx, "old.pwn", NULL, &back));
	assert_int_equal(back.nv, 10);
	assert_int_equal(mr_model_write(&ctx, "new.pwn", NULL, &none, NULL), MR_EMISSING);
	assert_int_equal(access("new.pwn", F_OK), -1);
	assert_int_equal(mr_model_write(&ctx, "/dev/full", "ply", &m, NULL), MR_EIO);
	assert_int_equal(mr_model_write(&ctx, "no/such/folder/a.ply", NULL, &m, NULL), MR_EIO);
	mr_ctx_free(&ctx);
}

int
main(void)
{
	const struct CMUnitTest tests[] = { cmocka_unit_test(round_trips), cmocka_unit_test(whole_models),
		cmocka_unit_test(blocks), cmocka_unit_test(properties), cmocka_unit_test(stl_round_trip),
		cmocka_unit_test(recognised), cmocka_unit_test(refusals), cmocka_unit_test(details),
		cmocka_unit_test(polygons), cmocka_unit_test(what_was_lost),
		cmocka_unit_test(what_was_rounded), cmocka_unit_test(names), cmocka_unit_test(whole_or_not) };

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
