export CLEPSYDRA_DEPENDENCIES=/work/main/.dependencies; cd /work/wt/loop; . scripts/environment
cmake --build build --target checkIdentification 2>&1 | grep -E 'error|FAILED' ; bash /tmp/diag/build.sh cov 2>&1 | grep -i ' error'; /tmp/diag/cov tests/identification/standIn/study.yaml > /tmp/diag/cov.txt; tail -14 /tmp/diag/cov.txt
