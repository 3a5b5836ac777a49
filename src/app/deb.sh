#!/bin/sh
# deb.sh BUILD VERSION: makes BUILD/cleave_VERSION_ARCHITECTURE.deb from a finished build (`make deb`). Needs dpkg-deb and
# dpkg-shlibdeps (package dpkg-dev), which name the libraries that the program is linked with.
set -eu
build=$1 version=$2
for tool in dpkg-deb dpkg-shlibdeps; do
    command -v $tool >/dev/null || { echo "$tool is missing: apt-get install dpkg-dev" >&2; exit 1; }
done
architecture=$(dpkg --print-architecture)
root=$build/deb/cleave
rm -rf "$build/deb"
make -s install BUILD="$build" DESTDIR="$root" PREFIX=/usr SEEN=/usr/lib/python3/dist-packages
strip --strip-unneeded --remove-section=.comment --remove-section=.note "$root/usr/bin/cleave"
gzip -n9 "$root/usr/share/man/man1/cleave.1"
[ ! -d "$root/usr/share/zsh/site-functions" ] || mv "$root/usr/share/zsh/site-functions" "$root/usr/share/zsh/vendor-completions"

documents=$root/usr/share/doc/cleave
mkdir -p "$root/DEBIAN" "$build/deb/debian"
gzip -n9c CHANGELOG.md >"$documents/changelog.gz"
{
    printf 'Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/\nUpstream-Name: Cleave\n\n'
    printf 'Files: *\n%s\nLicense: BSD-3-Clause\n' "$(sed -n 's/^Copyright (c)/Copyright:/p' LICENSE)"
    sed -n '/^Redistribution/,$ { s/^$/./; s/^/ /; p; }' LICENSE
} >"$documents/copyright"

# The libraries by the program's own list of them.
printf 'Source: cleave\n\nPackage: cleave\nArchitecture: any\n' >"$build/deb/debian/control"
libraries=$(cd "$build/deb" && dpkg-shlibdeps -O cleave/usr/bin/cleave 2>/dev/null | sed -n 's/^shlibs:Depends=//p')
[ -n "$libraries" ] || { echo "dpkg-shlibdeps found no packages of the program's libraries" >&2; exit 1; }
cat >"$root/DEBIAN/control" <<END
Package: cleave
Version: $version
Architecture: $architecture
Maintainer: Cleave developers <maintainers@cleave.example>
Installed-Size: $(du -sk "$root/usr" | cut -f 1)
Depends: $libraries, python3:any
Recommends: gnuplot-nox, python3-h5py, python3-numpy
Suggests: ffmpeg, paraview, python3-matplotlib, python3-pandas, python3-vtk9
Section: science
Priority: optional
Description: dynamic fracture by peridynamics and material points
 Cleave simulates how solids break: peridynamics where a body cracks, the
 material point method where it does not, and conversion from one to the
 other during the run. It runs on one multicore workstation from the command
 line and writes files for ParaView.
END
find "$root" -type d -exec chmod 755 {} +
find "$root/usr/share" -type f -exec chmod 644 {} +
(cd "$root" && find usr -type f | sort | xargs md5sum) >"$root/DEBIAN/md5sums"
package=$build/cleave_${version}_$architecture.deb
dpkg-deb --root-owner-group --build "$root" "$package" >/dev/null
echo "$package"
