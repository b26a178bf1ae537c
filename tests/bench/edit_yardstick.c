/*
 * edit_yardstick -- how an edit came out, beside the same edit as a smooth warp of space; usage:
 *	edit_yardstick EDIT BEFORE AFTER [PICTURE]  one line of JSON
 *	edit_yardstick --options EDIT BEFORE        the edit as options: a line for mr-select, one for mr-pose
 * EDIT is bend, twist or pull, or with an amount bend:DEGREES, twist:DEGREES, pull:PERCENT of the diagonal;
 * without one 60, 90 and 30.  BEFORE and AFTER are models of any format, or streams (.mrs), of which the
 * last frame's layer mesh is taken; AFTER has the vertices of BEFORE, in their order, and is taken to have
 * its faces.  PICTURE becomes a stream for mr-render, a frame of its name: AFTER with the longest axis
 * upwards and the second towards the eye in front, and a column harm, the colour of faces that are folded or
 * intersect near ones.
 *
 * All edits are along the longest axis of the bounding box, whose bottom fifth is fixed and whose top fifth
 * is moved: bent about the second longest axis or twisted about the longest, both through the middle, or
 * pulled along the longest.  The warp does that by u = 3s^2 - 2s^3, s from 0 at a fifth to 1 at four fifths,
 * to the mesh's own vertices: what its triangles cannot help doing.  A result is wrecked that has over 5
 * folded edges, or over 100 pairs of intersecting faces that are near along the surface, more than the warp.
 * Two limbs that meet are no wreck.
 */
#include "base/disjoint_sets.h"
#include "judge/judge.h"
#include "measure/measure.h"
#include "mesh/fold.h"
#include "space/contact.h"
#include "space/self_intersect.h"

#include "yardstick.h"

/* Faces that so many steps over edges lead to are near. */
enum { NEAR = 12, FOLDS_MORE = 5, PAIRS_MORE = 100 };

/* Vertices of the fixed and the moved fifth that are farther than this from where they belong, as a share of
 * the diagonal, are astray. */
static const double ASTRAY = 0.05;

/* Components touch that are nearer than this to each other, and have come apart when they are farther, as
 * shares of the diagonal. */
static const double TOUCH = 0.001, APART = 0.01;

/* What is not there any more counts as so many times too short or thin, as a binary logarithm. */
static const double LOST = 20;

enum { BEFORE, WARP, AFTER, STATES };

typedef enum kind { BEND, TWIST, PULL, KINDS } kind;

static const char *const names[KINDS] = { "bend", "twist", "pull" };
static const double amounts[KINDS] = { 60, 90, 30 };

typedef struct edit {
	kind kind;
	double amount; /* degrees, or per cent of the diagonal */
	int longest, second;
	mr_box box;
	mr_v3 middle;
} edit;

typedef struct figures {
	size_t folds, near_pairs; /* those that came with the motion */
	double volume;
	double off;         /* share of the edges longer than twice or shorter than half what they were */
	size_t apart;       /* vertices that touched another component */
	double edge_log2;   /* mean |log2| of the ratio of lengths */
	double aspect_log2; /* mean log2 of the ratio of the singular values of the faces' maps */
} figures;

/* ---- edits ---- */

static mr_v3
axis_vector(int k)
{
	return mr_vec(k == 0, k == 1, k == 2);
}

static mr_status
parse_edit(mr_ctx *ctx, const char *text, edit *e)
{
	char name[16], junk;

	for (int k = 0; k < KINDS; k++) {
		int n;
		e->kind = (kind)k;
		e->amount = amounts[k];
		if (!strcmp(text, names[k]))
			return MR_OK;
		n = sscanf(text, "%15[a-z]:%lf%c", name, &e->amount, &junk);
		if (n == 2 && !strcmp(name, names[k]) && isfinite(e->amount))
			return MR_OK;
	}
	return mr_fail(ctx, MR_EUSAGE, "%s: bend, twist or pull, with :AMOUNT or without", text);
}

static void
place_edit(edit *e, const mr_mesh *m)
{
	mr_v3 size;

	e->box = mr_box_of(m->p, m->nv);
	e->middle = mr_lerp(0.5, e->box.min, e->box.max);
	size = mr_sub(e->box.max, e->box.min);
	e->longest = mr_largest(size);
	size = mr_vec(
	    e->longest == 0 ? -1 : size.x, e->longest == 1 ? -1 : size.y, e->longest == 2 ? -1 : size.z);
	e->second = mr_largest(size);
}

static mr_v3
translation(const edit *e)
{
	return mr_mul(e->amount / 100 * mr_box_diagonal(e->box), axis_vector(e->longest));
}

static int
turning_axis(const edit *e)
{
	return e->kind == TWIST ? e->longest : e->second;
}

static void
print_options(const edit *e)
{
	char axis = "xyz"[e->longest];
	mr_v3 v;

	printf("--free all --fixed below:%c,0.2 --handle 0=above:%c,0.8\n", axis, axis);
	if (e->kind == PULL) {
		v = translation(e);
		printf("-H 0 --translate %.17g,%.17g,%.17g\n", v.x, v.y, v.z);
		return;
	}
	v = axis_vector(turning_axis(e));
	printf("-H 0 --rotate %g,%g,%g,%.17g --center %.17g,%.17g,%.17g\n", v.x, v.y, v.z, e->amount,
	    e->middle.x, e->middle.y, e->middle.z);
}

/* p about the unit axis n through 0 (Rodrigues). */
static mr_v3
turn(mr_v3 p, mr_v3 n, double radians)
{
	mr_v3 along = mr_mul(mr_dot(n, p), n), across = mr_sub(p, along);

	return mr_axpy(sin(radians), mr_cross(n, p), mr_axpy(cos(radians), across, along));
}

/* 0 where p is fixed, 1 where it is moved. */
static double
way_up(const edit *e, mr_v3 p)
{
	double low = mr_coordinate(e->box.min, e->longest), high = mr_coordinate(e->box.max, e->longest);
	double share = high > low ? (mr_coordinate(p, e->longest) - low) / (high - low) : 0;

	return fmin(1, fmax(0, (share - 0.2) / 0.6));
}

static mr_v3
warp_point(const edit *e, mr_v3 p)
{
	double s = way_up(e, p), u = s * s * (3 - 2 * s);

	if (e->kind == PULL)
		return mr_axpy(u, translation(e), p);
	return mr_add(
	    e->middle, turn(mr_sub(p, e->middle), axis_vector(turning_axis(e)), u * e->amount * MR_PI / 180));
}

/* ---- figures ---- */

/* Edges by face, to walk over them. */
typedef struct surface {
	const mr_v3 *p[STATES];
	mr_mesh m; /* positions: those before */
	mr_edges edges;
	uint32_t *edge; /* of each half-edge; MR_NONE of a face that has a vertex twice */
	mr_rgb *harm;   /* of the faces after */
} surface;

static mr_mesh
mesh_at(const surface *s, int state)
{
	mr_mesh m = s->m;

	m.p = s->p[state];
	return m;
}

static mr_status
build_surface(mr_ctx *ctx, surface *s)
{
	mr_edges_build(ctx, &s->m, &s->edges);
	s->edge = MR_NEW(ctx, 3 * s->m.nf, uint32_t);
	s->harm = MR_NEW(ctx, s->m.nf, mr_rgb);
	if (!s->edge || !s->harm)
		return MR_EMEM;
	for (size_t f = 0; f < s->m.nf; f++)
		s->harm[f] = sound;
	memset(s->edge, 0xff, 3 * s->m.nf * sizeof *s->edge);
	for (uint32_t e = 0; e < s->edges.count; e++)
		for (uint32_t i = s->edges.start[e]; i < s->edges.start[e + 1]; i++)
			s->edge[s->edges.he[i]] = e;
	return MR_OK;
}

typedef struct walk {
	uint32_t *from;  /* of each face, the face that last came by; MR_NONE: none */
	uint32_t *queue; /* faces, by distance */
	size_t n;
} walk;

static void
step_over(const surface *s, uint32_t h, uint32_t from, walk *w)
{
	uint32_t e = s->edge[h];

	if (e == MR_NONE)
		return;
	for (uint32_t i = s->edges.start[e]; i < s->edges.start[e + 1]; i++) {
		uint32_t g = s->edges.he[i] / 3;
		if (w->from[g] != from) {
			w->from[g] = from;
			w->queue[w->n++] = g;
		}
	}
}

/* The faces near `f`, itself the first. */
static void
find_near(const surface *s, uint32_t f, walk *w)
{
	size_t done = 0;

	w->n = 1;
	w->queue[0] = f;
	w->from[f] = f;
	for (int ring = 0; ring < NEAR; ring++)
		for (size_t end = w->n; done < end; done++)
			for (uint32_t h = 3 * w->queue[done]; h < 3 * w->queue[done] + 3; h++)
				step_over(s, h, f, w);
}

static void
corners(const mr_v3 *p, const mr_tri *t, mr_v3 out[3])
{
	for (int i = 0; i < 3; i++)
		out[i] = p[t->v[i]];
}

static bool
boxes_meet(mr_box a, mr_box b)
{
	return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y &&
	       a.min.z <= b.max.z && b.min.z <= a.max.z;
}

static bool
degenerate(const mr_v3 p[3])
{
	return mr_triangle_degenerate(p[0], p[1], p[2]);
}

static bool
intersect(const surface *s, int state, uint32_t f, uint32_t g)
{
	mr_v3 a[3], b[3];

	corners(s->p[state], &s->m.t[f], a);
	corners(s->p[state], &s->m.t[g], b);
	return boxes_meet(mr_box_of(a, 3), mr_box_of(b, 3)) && !degenerate(a) && !degenerate(b) &&
	       mr_triangles_intersect(a, b);
}

/* Pairs of `f` with later faces.  What stands as it did counts as it did: faces in one plane that touch
 * intersect or not as they are rounded. */
static size_t
count_pairs(surface *s, int state, uint32_t f, const walk *w)
{
	mr_mesh before = mesh_at(s, BEFORE), now = mesh_at(s, state);
	size_t n = 0;

	for (size_t i = 1; i < w->n; i++) {
		uint32_t g = w->queue[i];
		bool meets;
		if (g < f)
			continue;
		meets = intersect(s, state, f, g);
		if (meets != intersect(s, BEFORE, f, g) && mr_faces_stand(&before, &now, f, g))
			meets = !meets;
		if (!meets)
			continue;
		n++;
		if (state == AFTER)
			s->harm[f] = s->harm[g] = harmed;
	}
	return n;
}

static mr_status
count_near_pairs(mr_ctx *ctx, surface *s, figures *figure)
{
	walk w = { MR_NEW(ctx, s->m.nf, uint32_t), MR_NEW(ctx, s->m.nf, uint32_t), 0 };

	if (!w.from || !w.queue)
		return MR_EMEM;
	memset(w.from, 0xff, s->m.nf * sizeof *w.from);
	for (uint32_t f = 0; f < s->m.nf; f++) {
		find_near(s, f, &w);
		for (int state = 0; state < STATES; state++)
			figure[state].near_pairs += count_pairs(s, state, f, &w);
	}
	return MR_OK;
}

static double
log2_ratio(double after, double before)
{
	return after > 0 ? fmax(-LOST, fmin(LOST, log2(after / before))) : -LOST;
}

static void
compare_edges(const surface *s, int state, figures *figure)
{
	size_t n = 0, off = 0;
	double sum = 0;

	for (size_t e = 0; e < s->edges.count; e++) {
		uint32_t h = s->edges.he[s->edges.start[e]], i = mr_he_from(&s->m, h), j = mr_he_to(&s->m, h);
		double before = mr_dist(s->p[BEFORE][i], s->p[BEFORE][j]), ratio;
		if (before == 0)
			continue;
		ratio = log2_ratio(mr_dist(s->p[state][i], s->p[state][j]), before);
		n++;
		off += fabs(ratio) > 1;
		sum += fabs(ratio);
	}
	figure->off = n ? (double)off / (double)n : NAN;
	figure->edge_log2 = n ? sum / (double)n : NAN;
}

/*
 * log2 of the ratio of the singular values of the map of one triangle onto another.  With edges E = Q R
 * before, the map's square is C = R^-T (E'^T E') R^-1, and of trace and determinant of C follow its
 * eigenvalues, the squares.
 */
static double
aspect(const mr_v3 a[3], const mr_v3 b[3])
{
	mr_v3 e = mr_sub(a[1], a[0]), f = mr_sub(a[2], a[0]), g = mr_sub(b[1], b[0]), h = mr_sub(b[2], b[0]);
	double r11 = mr_norm(e), r12 = mr_dot(e, f) / r11, r22 = mr_norm(mr_cross(e, f)) / r11;
	mr_v3 u = mr_mul(1 / r11, g), v = mr_mul(1 / r22, mr_axpy(-r12, u, h)); /* E' R^-1 */
	double half = (mr_norm2(u) + mr_norm2(v)) / 2, area = mr_norm(mr_cross(u, v));
	double high = half + sqrt(fmax(0, half * half - area * area)); /* the other: area^2 / high */

	return area > 0 ? fmin(LOST, log2(high / area)) : LOST;
}

static void
compare_faces(const surface *s, int state, figures *figure)
{
	size_t n = 0;
	double sum = 0;

	for (size_t f = 0; f < s->m.nf; f++) {
		mr_v3 a[3], b[3];
		corners(s->p[BEFORE], &s->m.t[f], a);
		corners(s->p[state], &s->m.t[f], b);
		if (degenerate(a))
			continue;
		n++;
		sum += aspect(a, b);
	}
	figure->aspect_log2 = n ? sum / (double)n : NAN;
}

/* Of the vertices that the edit itself puts somewhere, the share that is not there: of parts that stay
 * behind. */
static double
share_astray(const edit *e, const surface *s)
{
	double most = ASTRAY * mr_box_diagonal(e->box);
	size_t n = 0, astray = 0;

	for (size_t v = 0; v < s->m.nv; v++) {
		double up = way_up(e, s->p[BEFORE][v]);
		if (up > 0 && up < 1)
			continue;
		n++;
		astray += mr_dist(s->p[WARP][v], s->p[AFTER][v]) > most;
	}
	return (double)astray / (double)n;
}

/* Mean distance from where the warp has the vertices, as a share of the diagonal: all of a whole turn that
 * came undone. */
static double
mean_from_warp(const edit *e, const surface *s)
{
	double sum = 0;

	for (size_t v = 0; v < s->m.nv; v++)
		sum += mr_dist(s->p[WARP][v], s->p[AFTER][v]);
	return sum / (double)s->m.nv / mr_box_diagonal(e->box);
}

typedef struct part {
	size_t vertices, held; /* held: in the fixed or the moved fifth */
	double warp, after;    /* sums of the ways that the vertices went */
} part;

static bool
stays(const edit *e, const part *p)
{
	double way = p->warp / (double)p->vertices;

	return !p->held && way > ASTRAY * mr_box_diagonal(e->box) && p->after < p->warp / 10;
}

/* Components between the fifths that the warp takes along and the edit does not. */
static mr_status
count_parts_left(mr_ctx *ctx, const edit *e, const surface *s, size_t *left)
{
	uint32_t *set = mr_sets_new(ctx, s->m.nv);
	part *parts = MR_NEW_ZERO(ctx, s->m.nv, part);

	if (!set || !parts)
		return MR_EMEM;
	for (size_t f = 0; f < s->m.nf; f++) {
		mr_sets_join(set, s->m.t[f].v[0], s->m.t[f].v[1]);
		mr_sets_join(set, s->m.t[f].v[1], s->m.t[f].v[2]);
	}
	for (uint32_t v = 0; v < s->m.nv; v++) {
		part *p = &parts[mr_sets_root(set, v)];
		double up = way_up(e, s->p[BEFORE][v]);
		p->vertices++;
		p->held += up == 0 || up == 1;
		p->warp += mr_dist(s->p[BEFORE][v], s->p[WARP][v]);
		p->after += mr_dist(s->p[BEFORE][v], s->p[AFTER][v]);
	}
	*left = 0;
	for (size_t v = 0; v < s->m.nv; v++)
		*left += parts[v].vertices && stays(e, &parts[v]);
	return MR_OK;
}

/* Vertices that touch another component before, and those of them that do not any more. */
static mr_status
count_apart(mr_ctx *ctx, const edit *e, const surface *s, figures *figure)
{
	double diagonal = mr_box_diagonal(e->box);
	mr_contacts contacts;
	uint32_t widest;

	mr_contacts_find(ctx, &s->m, TOUCH * diagonal, &contacts);
	figure[BEFORE].apart = contacts.vertices;
	for (int state = WARP; state <= AFTER; state++)
		figure[state].apart = mr_contacts_open(
		    &contacts, &s->m, s->p[state], APART * diagonal, &widest);
	return MR_OK;
}

static mr_status
measure(mr_ctx *ctx, const edit *e, surface *s, figures *figure)
{
	MR_TRY(count_apart(ctx, e, s, figure));
	MR_TRY(count_near_pairs(ctx, s, figure));
	for (int state = 0; state < STATES; state++) {
		mr_mesh m = mesh_at(s, state);
		mr_census census;
		mr_geometry geometry;
		mr_take_census(ctx, &m, &s->edges, &census);
		mr_measure_geometry(ctx, &m, &s->edges, &geometry);
		figure[state].folds = census.folded_edges;
		figure[state].volume = geometry.volume;
		compare_edges(s, state, &figure[state]);
		compare_faces(s, state, &figure[state]);
	}
	return MR_OK;
}

static size_t
more(size_t a, size_t b)
{
	return a > b ? a - b : 0;
}

static bool
wrecked(const figures *figure)
{
	return more(figure[AFTER].folds, figure[WARP].folds) > FOLDS_MORE ||
	       more(figure[AFTER].near_pairs, figure[WARP].near_pairs) > PAIRS_MORE;
}

/* ---- output ---- */

static void
print_count(const char *name, const figures *figure, size_t field)
{
	static const char *const suffix[STATES] = { "_before", "_warp", "" };

	for (int state = 0; state < STATES; state++)
		printf(",\"%s%s\":%zu", name, suffix[state],
		    *(const size_t *)((const char *)&figure[state] + field));
}

static void
print_figures(const edit *e, const surface *s, const figures *figure, size_t left)
{
	const figures *b = &figure[BEFORE], *w = &figure[WARP], *a = &figure[AFTER];

	printf("{\"edit\":\"%s\",\"amount\":%g,\"vertices\":%zu,\"faces\":%zu", names[e->kind], e->amount,
	    s->m.nv, s->m.nf);
	print_count("folds", figure, offsetof(figures, folds));
	print_count("near_pairs", figure, offsetof(figures, near_pairs));
	printf(",\"touching\":%zu,\"apart_warp\":%zu,\"apart\":%zu", b->apart, w->apart, a->apart);
	print_real("off_warp", w->off);
	print_real("off", a->off);
	print_real("edge_log2_warp", w->edge_log2);
	print_real("edge_log2", a->edge_log2);
	print_real("aspect_log2_warp", w->aspect_log2);
	print_real("aspect_log2", a->aspect_log2);
	print_real("volume_warp", w->volume / b->volume);
	print_real("volume", a->volume / b->volume);
	print_real("from_warp", mean_from_warp(e, s));
	print_real("astray", share_astray(e, s));
	printf(",\"parts_left\":%zu", left);
	printf(",\"folds_more\":%zu,\"pairs_more\":%zu,\"wrecked\":%d}\n", more(a->folds, w->folds),
	    more(a->near_pairs, w->near_pairs), wrecked(figure));
}

/* ---- pictures ---- */

static void
mark_folds(surface *s)
{
	mr_mesh m = mesh_at(s, AFTER);

	for (size_t e = 0; e < s->edges.count; e++) {
		const uint32_t *h = s->edges.he + s->edges.start[e];
		if (mr_edge_faces(&s->edges, e) == 2 &&
		    mr_folds(mr_face_cross(&m, h[0] / 3), mr_face_cross(&m, h[1] / 3), MR_FOLD))
			s->harm[h[0] / 3] = s->harm[h[1] / 3] = harmed;
	}
}

/* The result, its longest axis upwards and its second towards the eye. */
static mr_status
turn_upright(mr_ctx *ctx, const edit *e, const surface *s, mr_mesh *m)
{
	mr_v3 *p = MR_NEW(ctx, s->m.nv, mr_v3), up = axis_vector(e->longest), eye = axis_vector(e->second);
	mr_v3 right = mr_cross(up, eye);

	if (!p)
		return MR_EMEM;
	for (size_t v = 0; v < s->m.nv; v++) {
		mr_v3 q = s->p[AFTER][v];
		p[v] = mr_vec(mr_dot(right, q), mr_dot(up, q), mr_dot(eye, q));
	}
	*m = mesh_at(s, AFTER);
	m->p = p;
	return MR_OK;
}

static mr_status
draw(mr_ctx *ctx, const edit *e, surface *s, const char *path, bool wreck)
{
	mr_mesh m;

	mark_folds(s);
	MR_TRY(turn_upright(ctx, e, s, &m));
	return write_picture(ctx, path, wreck ? " WRECKED" : "", &m, s->harm);
}

static mr_status
warp(mr_ctx *ctx, const edit *e, surface *s)
{
	mr_v3 *p = MR_NEW(ctx, s->m.nv, mr_v3);

	if (!p)
		return MR_EMEM;
	for (size_t i = 0; i < s->m.nv; i++)
		p[i] = warp_point(e, s->m.p[i]);
	s->p[WARP] = p;
	return MR_OK;
}

static mr_status
judge(mr_ctx *ctx, const edit *e, const mr_mesh *before, const char *path, const char *picture)
{
	surface s = { .m = *before };
	figures figure[STATES] = { 0 };
	mr_mesh after;
	size_t left;

	MR_TRY(read_mesh(ctx, path, &after));
	if (after.nv != s.m.nv)
		return mr_fail(ctx, MR_EMESH, "%s: %zu vertices, not %zu", path, after.nv, s.m.nv);
	s.p[BEFORE] = before->p;
	s.p[AFTER] = after.p;
	MR_TRY(warp(ctx, e, &s));
	MR_TRY(build_surface(ctx, &s));
	MR_TRY(measure(ctx, e, &s, figure));
	MR_TRY(count_parts_left(ctx, e, &s, &left));
	print_figures(e, &s, figure, left);
	return picture ? draw(ctx, e, &s, picture, wrecked(figure)) : MR_OK;
}

static mr_status
run(mr_ctx *ctx, char **argv)
{
	bool options = !strcmp(argv[1], "--options");
	edit e;
	mr_mesh before;

	MR_TRY(parse_edit(ctx, argv[options ? 2 : 1], &e));
	MR_TRY(read_mesh(ctx, argv[options ? 3 : 2], &before));
	place_edit(&e, &before);
	if (!options)
		return judge(ctx, &e, &before, argv[3], argv[4]);
	print_options(&e);
	return MR_OK;
}

int
main(int argc, char **argv)
{
	mr_ctx ctx;
	int failed = 1;

	if (argc < 4 || argc > 5) {
		fprintf(
		    stderr, "usage: edit_yardstick EDIT BEFORE AFTER [PICTURE] | --options EDIT BEFORE\n");
		return 2;
	}
	mr_ctx_init(&ctx, 0);
	if (run(&ctx, argv) < 0)
		fprintf(stderr, "edit_yardstick: %s\n", ctx.error);
	else
		failed = fflush(stdout) != 0;
	mr_ctx_free(&ctx);
	return failed;
}
