mr-compare a.mrs b.mrs </dev/null
