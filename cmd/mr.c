/* mr -- the front end: lists the tools by job, runs one, opens its page, describes all.  See man/mr.1. */
#include "base/text.h"
#include "options.h"

#include <errno.h>
#include <sys/wait.h>
#include <unistd.h>

enum { EXIT_GOOD = 0, EXIT_DATA = 1, EXIT_USAGE = 2, PATH_MOST = 4096 };

typedef struct tool {
	const char *name, *does; /* smooth; NULL: `does` heads a job */
} tool;

static const tool tools[] = {
	{ NULL, "Read, write, look" },
	{ "import", "read models and scans: OBJ, PLY, STL, OFF, glTF, LAS, PCD, text" },
	{ "export", "write models" },
	{ "make", "make shapes" },
	{ "cat", "join, append, pick, pack streams" },
	{ "info", "print figures and faults" },
	{ "compare", "measure distances of two surfaces" },
	{ "render", "make pictures" },
	{ "view", "make a page that turns and poses the model" },
	{ NULL, "Repair and prepare" },
	{ "fill", "fill holes" },
	{ "crop", "keep a part" },
	{ "split", "part components" },
	{ "transform", "move, turn, scale" },
	{ "align", "align scans" },
	{ "normals", "estimate normals of points" },
	{ NULL, "Remesh and simplify" },
	{ "remesh", "make triangles even" },
	{ "simplify", "reduce faces; make control meshes" },
	{ "subdivide", "refine by Loop's or by linear subdivision" },
	{ "map", "make texture atlases; bake colours and normals" },
	{ NULL, "Deform and keep the detail" },
	{ "smooth", "make the smooth base surface" },
	{ "select", "select what is fixed, free, or a handle" },
	{ "encode", "store the detail over the base" },
	{ "pose", "move handles" },
	{ "solve", "deform the base" },
	{ "decode", "put the detail back" },
	{ NULL, "Surfaces from scans, in few bytes" },
	{ "shrinkwrap", "wrap points" },
	{ "fit", "fit the control mesh to the points" },
	{ "sample", "sample heights over the control mesh" },
	{ "equalize", "weigh the levels of heights" },
	{ "pack", "write the surface in few bytes" },
	{ "unpack", "read it" },
	{ NULL, NULL },
};

static int
usage(FILE *out)
{
	fprintf(out, "usage: mr TOOL [ARGUMENT...]   runs mr-TOOL\n"
		     "       mr help TOOL            opens its page\n"
		     "       mr --json               describes every tool and option\n"
		     "       mr --version\n");
	for (const tool *t = tools; t->does; t++)
		if (t->name)
			fprintf(out, "  %-12s%s\n", t->name, t->does);
		else
			fprintf(out, "\n%s\n", t->does);
	return out == stdout && (fflush(out) || ferror(out)) ? EXIT_DATA : EXIT_GOOD;
}

/* The program of a tool: beside this one if that was called by a path, else wherever PATH finds it. */
static bool
find_program(const char *self, const char *name, char path[PATH_MOST])
{
	const char *slash = strrchr(self, '/');
	int folder = slash ? (int)(slash + 1 - self) : 0;

	return snprintf(path, PATH_MOST, "%.*smr-%s", folder, self, name) < PATH_MOST;
}

static const tool *
find_tool(const char *name)
{
	if (!strncmp(name, "mr-", 3))
		name += 3;
	for (const tool *t = tools; t->does; t++)
		if (t->name && !strcmp(t->name, name))
			return t;
	return NULL;
}

static int
fail_unknown(const char *word)
{
	const char *like = NULL;
	size_t n = strlen(word), best = n > 1 ? n / 2 + 1 : 0;

	for (const tool *t = tools; t->does; t++) {
		size_t d = t->name ? cmd_unlike(word, n, t->name) : best;
		if (d < best) {
			best = d;
			like = t->name;
		}
	}
	fprintf(stderr, "mr: there is no tool '%s'%s%s%s\nTry 'mr' for a list.\n", word,
	    like ? ": did you mean " : "", like ? like : "", like ? "?" : "");
	return EXIT_USAGE;
}

static int
fail_to_start(const char *path)
{
	fprintf(stderr, "mr: %s: %s\n", path, strerror(errno));
	return EXIT_DATA;
}

/* Becomes mr-TOOL. */
static int
run(const char *self, const tool *t, char **arguments)
{
	char path[PATH_MOST];

	if (!find_program(self, t->name, path))
		return fail_unknown(t->name);
	arguments[0] = path;
	execvp(path, arguments);
	return fail_to_start(path);
}

/* Opens the page; without man prints what --help does. */
static int
help(const char *self, const char *name)
{
	const tool *t = find_tool(name);
	char page[32], option[] = "--help", *arguments[] = { NULL, option, NULL };

	if (!t)
		return fail_unknown(name);
	snprintf(page, sizeof page, "mr-%s", t->name);
	execlp("man", "man", page, (char *)NULL);
	return run(self, t, arguments);
}

/* The tool describes itself on our standard output. */
static bool
describe(const char *self, const tool *t)
{
	char path[PATH_MOST], option[] = "--describe", *arguments[] = { path, option, NULL };
	int status = EXIT_DATA;
	pid_t child;

	if (!find_program(self, t->name, path) || fflush(stdout))
		return false;
	child = fork();
	if (child == 0) {
		execvp(path, arguments);
		_exit(EXIT_USAGE);
	}
	return child > 0 && waitpid(child, &status, 0) == child && status == 0;
}

static int
describe_all(const char *self)
{
	const char *before = "[\n";

	for (const tool *t = tools; t->does; t++) {
		if (!t->name)
			continue;
		fputs(before, stdout);
		if (!describe(self, t)) {
			fprintf(stderr, "mr: mr-%s --describe failed\n", t->name);
			return EXIT_DATA;
		}
		before = ",";
	}
	puts("]");
	return fflush(stdout) || ferror(stdout) ? fail_to_start("stdout") : EXIT_GOOD;
}

int
main(int argc, char **argv)
{
	const tool *t;

	if (argc < 2 || !strcmp(argv[1], "--help") || !strcmp(argv[1], "-h"))
		return usage(stdout);
	if (!strcmp(argv[1], "--version") || !strcmp(argv[1], "-V"))
		return printf("mr %s\n", MR_VERSION) < 0 || fflush(stdout) ? EXIT_DATA : EXIT_GOOD;
	if (!strcmp(argv[1], "--json"))
		return describe_all(argv[0]);
	if (!strcmp(argv[1], "help"))
		return argc > 2 ? help(argv[0], argv[2]) : usage(stdout);
	t = find_tool(argv[1]);
	return t ? run(argv[0], t, argv + 1) : fail_unknown(argv[1]);
}
