mr-compare a.mrs b.mrs c.mrs </dev/null
