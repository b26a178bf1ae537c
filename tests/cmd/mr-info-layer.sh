mr-make plane -n 9 | mr-info -l base
