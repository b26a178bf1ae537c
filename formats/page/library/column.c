/* The values of a packed column from the planes that it was inflated to. */
#include "formats/page/library/export.h"
#include "stream/planes.h"

MR_EXPORT(column_join)
void
column_join(const unsigned char *planes, size_t rows, size_t components, size_t size, unsigned char *out)
{
	for (size_t first = 0; first < rows; first += MR_PLANE_ROWS) {
		size_t at = first * components * size, n = rows - first;
		mr_planes_join(
		    planes + at, n < MR_PLANE_ROWS ? n : MR_PLANE_ROWS, components, size, out + at);
	}
}
