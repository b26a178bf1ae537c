# A stream that was cut off is reported as far as it goes, and fails.
mr-make sphere -n 500 >s.mrs
head -c 20000 s.mrs | mr-info
