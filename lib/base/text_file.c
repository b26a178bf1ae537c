/* A file read whole and taken line by line, with the number of the line for sentences. */
#include "base/text_file.h"

#include <errno.h>
#include <math.h>

static void
close_file(void *in)
{
	fclose(in);
}

static mr_status
read_all(mr_ctx *ctx, const char *path, char **text, size_t *length)
{
	size_t room = 0, n = 0;
	char *bytes = NULL;
	FILE *in;
	mr_status status = MR_OK;

	MR_TRY(mr_permit(ctx, path, false));
	in = fopen(path, "rb");
	if (!in)
		return mr_fail(ctx, MR_EIO, "%s: %s", path, strerror(errno));
	mr_own(ctx, close_file, in);
	do {
		MR_RESERVE(ctx, bytes, n, 4096, &room);
		n += fread(bytes + n, 1, room - 1 - n, in);
	} while (n == room - 1);
	if (ferror(in))
		status = mr_fail(ctx, MR_EIO, "%s: %s", path, strerror(errno));
	if (status == MR_OK && memchr(bytes, 0, n))
		status = mr_fail(ctx, MR_EFORMAT, "%s: a zero byte: not a text file", path);
	if (status != MR_OK)
		return status;
	bytes[n] = '\0';
	if (!strncmp(bytes, "\xef\xbb\xbf", 3)) { /* the mark that begins UTF-8 */
		n -= 3;
		memmove(bytes, bytes + 3, n + 1);
	}
	*text = bytes;
	*length = n;
	return MR_OK;
}

static bool
is_space(char c)
{
	return c == ' ' || c == '\t' || c == '\r';
}

/* Ends the line at its comment and its last word; returns where its first word begins. */
static char *
strip(char *line)
{
	char *end = line + strcspn(line, "#");

	while (end > line && is_space(end[-1]))
		end--;
	*end = '\0';
	while (is_space(*line))
		line++;
	return line;
}

mr_status
mr_lines_read(mr_ctx *ctx, const char *path, char ***line, size_t *count)
{
	size_t length = 0, n = 1, i = 0;
	char *text = "", **lines;

	MR_TRY(read_all(ctx, path, &text, &length));
	for (size_t k = 0; k < length; k++)
		n += text[k] == '\n';
	lines = MR_NEW(ctx, n, char *);
	for (char *at = text; i < n; i++) {
		char *end = at + strcspn(at, "\n");
		*end = '\0';
		lines[i] = strip(at);
		at = end + 1;
	}
	*line = lines;
	*count = n;
	return MR_OK;
}

bool
mr_numbers(const char **at, size_t n, double *x)
{
	for (size_t i = 0; i < n; i++) {
		char *end;
		if (i > 0 && *(*at)++ != ',')
			return false;
		if (!**at || !strchr("+-.0123456789", **at)) /* strtod would skip spaces and take "inf" */
			return false;
		x[i] = strtod(*at, &end);
		if (end == *at || !isfinite(x[i]))
			return false;
		*at = end;
	}
	return true;
}

bool
mr_whole(const char **at, uint64_t most, uint64_t *x)
{
	unsigned long long n;
	char *end;

	if (**at < '0' || **at > '9')
		return false;
	errno = 0;
	n = strtoull(*at, &end, 10);
	*at = end;
	*x = n;
	return !errno && n <= most;
}
