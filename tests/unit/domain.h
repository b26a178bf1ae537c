/* domain.h -- domains of control meshes for unit tests. */
#ifndef TEST_DOMAIN_H
#define TEST_DOMAIN_H

#include "subdivide/displaced.h"
#include "unit.h"

/* That of level n, without creases. */
static inline mr_domain
domain(const mr_mesh *control, size_t n)
{
	mr_loop *level = MR_NEW(&ctx, n + 1, mr_loop);
	mr_domain d;

	assert_int_equal(mr_loop_levels(&ctx, control, 180, NULL, n, level), MR_OK);
	mr_domain_on(&ctx, control, level, n, &d);
	return d;
}

#endif
