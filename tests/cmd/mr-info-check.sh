# --check passes what the tools make.
mr-make sphere -n 500 | mr-info --check --json | grep -o '"broken":.*'
mr-make torus --points 100 | mr-info --check | tail -n 1
