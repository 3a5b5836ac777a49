#!/bin/sh
# Checks the list of faults for `make mutants`: each old text occurs exactly once in its file, and each test that it names exists.
test_name=test_mutants
. tests/support/summary.sh

TESTS=$(find tests -name 'test_*.c' -o -name 'test_*.sh' -o -name 'house.sh') JOBS=
export TESTS JOBS
list=tests/robustness/mutants/list.txt
said=$(awk -f tests/robustness/mutants/list.awk "$list")
is "faults that are none" "$said" ""
between "faults" "$(grep -c '^[^#]' "$list")" 80 100000

# Errors in the list are reported with list and line.
cat >"$work/list" <<'END'
# a comment

src/base/base.c @ no such text @ x @ test_ground
src/base/base.c @ return @ exit @ test_ground
src/base/none.c @ a @ b @ test_ground
include/base/rise.h @ CLEAVE_BASE_RISE @ @ test_ground
Makefile @ VERSION  := 0.2.0 @ VERSION  := 0.2.1 @ test_none
Makefile @ VERSION  := 0.2.0 @ VERSION  := 0.2.1 @ test_ground tests/unit/mesh/test_mesh.c test_contact.sh test_bar
END
awk -f tests/robustness/mutants/list.awk "$work/list" >"$work/said"
is "lines with a fault that is none" "$(sed "s|^$work/||; s|:.*||" "$work/said" | sort -u)" "list"
is "faults that are none, by line" "$(sed 's|^[^:]*:\([0-9]*\): \([^:]*\): \([a-z ]*\).*|\1 \2 \3|' "$work/said" | paste -s -d ';')" \
    "3 src/base/base.c text not found;4 src/base/base.c text occurs ;5 src/base/none.c no such file;6 include/base/rise.h ;7 Makefile no such test"
finish
