#!/bin/sh
# Files installed by `make install` and removed by `make uninstall`; completion in bash; the tarball of `make dist`; help of every command.
test_name=install
. tests/support/summary.sh
# A folder of the build of its own, as `make install` writes to it: the program alone.
build=$work/build
mkdir "$build" && cp "$cleave" "$build"

prefix=$work/prefix
make -s install BUILD="$build" PREFIX="$prefix" -o all >"$work/log" 2>&1 || fail "make install: $(cat "$work/log")"
holds "the program runs from there" "$prefix/bin/cleave" info >/dev/null
holds "the manual page names a key" grep -q '^.B particles.horizon$' "$prefix/share/man/man1/cleave.1"
holds "and every command" test "$(grep -c '^.B cleave [a-z]' "$prefix/share/man/man1/cleave.1")" = \
    "$("$cleave" --help | grep -c '^  cleave')"

# ---- completion ------------------------------------------------------------------------------------------------------

# complete WORDS...: prints what bash offers for the last of these words.
complete()
{
    bash -c '. "$0"; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _cleave 2>/dev/null; printf "%s\n" "${COMPREPLY[@]}"' \
        "$prefix/share/bash-completion/completions/cleave" "$@" | tr '\n' ' '
}
if command -v bash >/dev/null; then
    is "completes a command" "$(complete cleave swe)" "sweep "
    is "completes a key" "$(complete cleave run x.yaml -s particles.sp)" "particles.spacing= "
    is "completes a key of a list" "$(complete cleave run x.yaml -s boundary.0.bod)" "boundary.0.body= boundary.0.body_force= "
    is "completes an option" "$(complete cleave run --res)" "--resume "
    is "completes a scene" "$(complete cleave check inputs/plate_cr)" "inputs/plate_crack.yaml "
fi
holds "the completion of zsh names a command" grep -q "sweep" "$prefix/share/zsh/site-functions/_cleave"

# ---- documents -------------------------------------------------------------------------------------------------------

documents=$prefix/share/doc/cleave
for file in LICENSE CITATION.cff CHANGELOG.md README.md inputs/README.md inputs/blade.stl inputs/new/bar.yaml; do
    holds "$file is installed" test -s "$documents/$file"
done
# Each link of a page leads to a file that is installed.
(cd "$documents" && find . -name '*.md' | while read -r page; do
    { grep -o '](\([^)]*\))' "$page" | sed 's/^](//; s/)$//'; grep -o 'src="[^"]*"' "$page" | sed 's/src="//; s/"$//'; } |
        sed 's/#.*//' | grep -v '^https:' | sort -u | while read -r link; do
        [ -z "$link" ] || [ -e "$(dirname "$page")/$link" ] || echo "$page: $link"
    done
done) >"$work/list"
is "links of installed documents that lead nowhere" "$(cat "$work/list")" ""
is "cleave help says where the manual is" "$(cd "$work" && "$prefix/bin/cleave" help loads | sed -n 2p)" "inputs/ is $documents/inputs"
holds "an installed scene is sound" "$prefix/bin/cleave" check --no-trial "$documents/inputs/plate_crack.yaml" >/dev/null 2>&1
for file in src/python/cleave/*.py src/python/cleave/py.typed; do
    holds "$file is installed" test -n "$(find "$prefix/lib" -path "*/cleave/$(basename "$file")")"
done
schema=$(sed -n '1s/.*schema=//p' "$documents/inputs/plate_crack.yaml")
holds "and names the installed schema" test -s "$documents/inputs/$schema"
schema=$(sed -n '1s/.*schema=//p' "$documents/inputs/new/bar.yaml")
holds "so does one of cleave new" test -s "$documents/inputs/new/$schema"

# ---- version ---------------------------------------------------------------------------------------------------------

version=$(sed -n 's/^VERSION *:= *//p' Makefile)
is "version" "$("$cleave" --version | cut -d ' ' -f 1-2)" "cleave $version"
for file in CITATION.cff CHANGELOG.md src/python/cleave/__init__.py; do holds "$file names version $version" grep -q "$version" $file; done
# The commit is written anew only where it changes, and is empty where the tree is in no git repository of its own.
mkdir "$work/none"
(cd "$work/none" && sh "$OLDPWD/src/app/commit.sh" commit.h && touch -d 2001-01-01 commit.h && sh "$OLDPWD/src/app/commit.sh" commit.h)
is "without git" "$(cat "$work/none/commit.h")" '#define CLEAVE_COMMIT ""'
holds "an equal commit is left as it is" test "$(date -r "$work/none/commit.h" +%Y)" = 2001
if command -v git >/dev/null; then
    (cd "$work/none" && git init -q . && git -c user.name=x -c user.email=x@example.org commit -q --allow-empty -m x &&
        sh "$OLDPWD/src/app/commit.sh" commit.h)
    holds "with git" grep -qE '^#define CLEAVE_COMMIT "[0-9a-f]{10}\+?"$' "$work/none/commit.h"
fi

make -s uninstall BUILD="$build" PREFIX="$prefix" >"$work/log" 2>&1 || fail "make uninstall: $(cat "$work/log")"
is "files that uninstall leaves" "$(find "$prefix" ! -type d)" ""

# ---- tarball ---------------------------------------------------------------------------------------------------------

mkdir "$work/here" && tar -c --exclude='./.git' --exclude='./build*' --exclude='./results' . | tar -x -C "$work/here"
(cd "$work/here" && make -s dist BUILD="$work/dist") >"$work/log" 2>&1 || fail "make dist: $(cat "$work/log")"
tar -tzf "$work/dist/"cleave-*.tar.gz >"$work/list" || fail "the tarball cannot be read"
for file in Makefile README.md LICENSE CITATION.cff CHANGELOG.md .clang-format .clang-tidy .editorconfig .github/CONTRIBUTING.md \
    src/app/main.c kernels/kernels.h tests/house.sh inputs/kalthoff_winkler.yaml; do
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
is "and its line" "$(cat "$work/err")" "unknown command rnu; did you mean run?"
"$cleave" help thoery 2>"$work/err"
is "a mistyped page" "$(cat "$work/err")" "thoery: this is neither a page nor a key; did you mean theory?"
for word in adaptive bond ospd peridynamics results resume python fragment impact branching example tutorial wave modulus stress; do
    holds "help $word answers" "$cleave" help $word >"$work/out"
done
"$cleave" help gold 2>"$work/err"
is "a word that is like no key" "$(cut -d ';' -f 1 "$work/err")" "gold: neither a key nor a page"
is "a reader that leaves" "$("$cleave" help 2>&1 | head -n 1 | wc -l)" 1
holds "options of a command by what they are of it" test "$("$cleave" plot --help | grep -c '^  -o FILE')" = 1
finish
