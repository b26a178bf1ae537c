mr-make plane -n 9 | mr-compare
