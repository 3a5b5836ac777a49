#!/bin/sh
# commit.sh FILE: writes the header FILE with CLEAVE_COMMIT, the commit of this source tree ("+" behind it: with changes), or "" where
# the tree is in no git repository of its own or git is missing. FILE keeps its time where the commit is the same, and its contents
# where git refuses to read the repository, as in `sudo make install`.
set -eu
commit=
if [ -e .git ] && command -v git >/dev/null 2>&1; then
    if ! commit=$(git --no-optional-locks describe --always --abbrev=10 --exclude='*' --dirty=+ 2>/dev/null); then
        [ ! -f "$1" ] || exit 0
        commit=
    fi
fi
printf '#define CLEAVE_COMMIT "%s"\n' "$commit" >"$1.new"
if cmp -s "$1.new" "$1"; then rm "$1.new"; else mv "$1.new" "$1"; fi
