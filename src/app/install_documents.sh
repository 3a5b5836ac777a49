#!/bin/sh
# install_documents.sh FOLDER: copies licence, README, manual and scenes, with the files that they name, to FOLDER, laid out as in the
# source tree, so that links and commands of the manual hold there (`make install`). Prints the folder.
set -eu
to=$1
mkdir -p "$to"
for file in LICENSE CITATION.cff CHANGELOG.md README.md .github/CONTRIBUTING.md .github/SECURITY.md bench/README.md kernels/README.md \
    src/README.md tests/README.md; do
    install -D -m 644 "$file" "$to/$file"
done
for file in inputs/*.* inputs/new/*.* bench/claims.csv bench/accuracy/cost_accuracy.csv bench/results/*.* \
    tests/robustness/mutants/list.txt; do install -D -m 644 "$file" "$to/$file"; done
# The schema for editors lies beside the documents of an installed program, not in a folder of builds.
sed -i '1s|=\.\./build/|=../../../cleave/|' "$to"/inputs/*.yaml
sed -i '1s|=\.\./\.\./build/|=../../../../cleave/|' "$to"/inputs/new/*.yaml
echo "$to"
