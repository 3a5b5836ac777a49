#!/bin/sh
# What `make install` lays down and `make uninstall` takes away; completion as bash has it; the tarball of `make dist`; help behind
# every command. Runs alone: the folder of the build, into which `make install` writes, is that of all tests.
test_name=install
. tests/support/summary.sh
build=${BUILD:-build}

prefix=$work/prefix
make -s install BUILD="$build" PREFIX="$prefix" -o all >"$work/log" 2>&1 || fail "make install: $(cat "$work/log")"
holds "the program runs from there" "$prefix/bin/cleave" info >/dev/null
holds "the manual page names a key" grep -q '^.B particles.horizon$' "$prefix/share/man/man1/cleave.1"
holds "and every command" test "$(grep -c '^.B cleave [a-z]' "$prefix/share/man/man1/cleave.1")" = \
    "$("$cleave" --help | grep -c '^  cleave')"

# ---- completion ------------------------------------------------------------------------------------------------------

# complete WORDS...: what bash offers for the last of these words
complete()
{
    bash -c '. "$0"; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _cleave 2>/dev/null; printf "%s\n" "${COMPREPLY[@]}"' \
        "$prefix/share/bash-completion/completions/cleave" "$@" | tr '\n' ' '
}
if command -v bash >/dev/null; then
    is "completes a command" "$(complete cleave swe)" "sweep "
    is "completes a key" "$(complete cleave run x.yaml -s particles.sp)" "particles.spacing= "
    is "completes a key of a list" "$(complete cleave run x.yaml -s boundary.0.bod)" "boundary.0.body= boundary.0.body_force= "
    is "completes an option" "$(complete cleave run --re)" "--resume "
    is "completes a scene" "$(complete cleave check inputs/plate_cr)" "inputs/plate_crack.yaml "
fi
holds "the completion of zsh names a command" grep -q "sweep" "$prefix/share/zsh/site-functions/_cleave"

make -s uninstall BUILD="$build" PREFIX="$prefix" >"$work/log" 2>&1 || fail "make uninstall: $(cat "$work/log")"
is "files that uninstall leaves" "$(find "$prefix" -type f)" ""

# ---- tarball ---------------------------------------------------------------------------------------------------------

mkdir "$work/here" && cp -r Makefile README.md src include kernels bench tests inputs "$work/here/"
(cd "$work/here" && make -s dist BUILD="$work/dist") >"$work/log" 2>&1 || fail "make dist: $(cat "$work/log")"
tar -tzf "$work/dist/"cleave-*.tar.gz >"$work/list" || fail "the tarball cannot be read"
for file in Makefile README.md src/app/main.c kernels/kernels.h tests/house.sh inputs/kalthoff_winkler.yaml; do
    holds "the tarball has $file" grep -q "^cleave-[0-9.]*/$file\$" "$work/list"
done

# ---- help ------------------------------------------------------------------------------------------------------------

for command in $("$cleave" --help | sed -n 's/^  cleave \([a-z]*\) .*/\1/p'); do
    "$cleave" $command something --help >"$work/out" 2>"$work/err"
    is "$command something --help: exit status" $? 0
    is "$command something --help: first words" "$(head -n 1 "$work/out" | cut -d ' ' -f 1-2)" "cleave $command"
done
for page in units run theory trust; do
    holds "help $page says something" test "$("$cleave" help $page | wc -l)" -gt 10
done
"$cleave" rnu 2>"$work/err"
is "a mistyped command: exit status" $? 2
is "and its line" "$(cat "$work/err")" "unknown command rnu; the nearest is run"
"$cleave" help thoery 2>"$work/err"
is "a mistyped page" "$(cat "$work/err")" "thoery: neither a page nor a key; the nearest is theory"
is "a reader that leaves" "$("$cleave" help 2>&1 | head -n 1 | wc -l)" 1
holds "options of a command by what they are of it" test "$("$cleave" plot --help | grep -c '^  -o FILE')" = 1
finish
