# Cleave: settings
CC       ?= gcc
ARCH     ?=
OPTIMISE ?= -O3
DEBUG    ?= -g1
PREFIX   ?= /usr/local
BUILD    ?= build
THREADS  ?= 2
VERSION  := 0.2.0

# Options, if the compiler knows them all; a linker, if it is there.
known = $(shell $(CC) -Werror $(1) -x c -c -o /dev/null /dev/null 2>/dev/null && echo '$(1)')
there = $(shell $(CC) $(1) -Wl,--version >/dev/null 2>&1 && echo '$(1)')

WARN     := -Wall -Wextra -Wshadow -Werror=implicit-function-declaration -Wno-unknown-pragmas -Wno-psabi
WARN     += $(if $(call known,-Wpass-failed),-Wno-pass-failed)
LIBRARIES := hdf5 hwloc yaml-0.1 libpng libtiff-4

# What POSIX has and the usual rest; files that call functions of GNU alone define _GNU_SOURCE, with which math.h takes the compiler three
# times as long.
CPPFLAGS += -I. -Iinclude -I$(BUILD) -D_XOPEN_SOURCE=700 -D_DEFAULT_SOURCE -DCLEAVE_VERSION='"$(VERSION)"'
CFLAGS   += -std=c11 $(OPTIMISE) $(DEBUG) -ffp-contract=fast -fno-math-errno -fno-trapping-math -fopenmp $(WARN)
# Asked once, when the first recipe needs them: the targets that install packages read this file before those are there.
LIBFLAGS  = $(eval LIBFLAGS := $(shell pkg-config --cflags $(LIBRARIES)))$(LIBFLAGS)
SHARED    = $(eval SHARED := $(shell pkg-config --libs $(LIBRARIES)) -lm)$(SHARED)

# Libraries of files as archives where these link: shared, HDF5 loads 30 other libraries (curl, Kerberos), TIFF 9 (all that its files can be
# packed with, one in C++) and the others 2, which takes two thirds of the time of a start.
archive   = $(shell file=$$(mktemp); echo 'int $(1)(void); int main(void) { return $(1)(); }' | \
            $(CC) -x c -o $$file - $(2) 2>/dev/null && echo '$(2)'; rm -f $$file)
FILES    := hdf5 yaml-0.1 libpng
FILED     = $(patsubst -lhdf5,-l:libhdf5.a,$(shell pkg-config --libs hdf5)) $(addprefix -l:lib,sz.a aec.a yaml.a png16.a z.a) -lm
PACKERS  := webp Lerc jbig zstd lzma jpeg deflate z stdc++
LIBS      = $(eval LIBS := $(or $(call archive,H5open,$(FILED)),$(shell pkg-config --libs $(FILES))) \
            $(or $(call archive,TIFFGetVersion,-l:libtiff.a $(PACKERS:%=-l:lib%.a) -lm),$(shell pkg-config --libs libtiff-4)) \
            $(shell pkg-config --libs $(filter-out libtiff-4 $(FILES),$(LIBRARIES))) -lm)$(LIBS)

# Kernels are compiled once for each set of vector instructions; the program takes one at start (src/simd/simd.c). The rest is
# for any machine of its kind, or for ARCH (native, ...). Debuggers see their lines, not their variables (-g1), which of code
# that is all inlined takes the compiler a quarter of its time. On x86 processors the portable set is for those made before 2013 alone:
# -O1 compiles it in a quarter of the time of -O3.
rest     := $(ARCH:%=-march=%)
X86      := $(findstring x86_64,$(shell $(CC) -dumpmachine))
SETS     := $(if $(X86),avx512 avx2) portable
BENCHES  := yes
avx512   := -march=x86-64-v4 -mprefer-vector-width=512
avx2     := -march=x86-64-v3 $(call known,-mmove-max=256 -mstore-max=256)
portable := $(if $(X86),-march=x86-64 -Wno-maybe-uninitialized $(OPTIMISE:-O3=-O1),$(rest))

# FIRST=1 leaves out what the first run on this machine does not need: benches, and kernels for other processors.
ifdef FIRST
macros   := $(shell $(CC) -march=native -dM -E -x c /dev/null 2>/dev/null)
SETS     := $(if $(X86),$(if $(filter __AVX512VL__,$(macros)),avx512,$(if $(filter __AVX2__,$(macros)),avx2,portable)),portable)
BENCHES  :=
endif

SOURCES  := $(sort $(shell find src $(if $(BENCHES),bench) -name '*.c'))
KERNELS  := $(sort $(shell find kernels -name '*.c'))
TESTS    := $(sort $(shell find tests -name 'test_*.c'))
# Kernels take longest: they come first, so that no core waits for the last of them.
OBJECTS  := $(foreach set,$(SETS),$(KERNELS:%.c=$(BUILD)/%.$(set).o)) $(SOURCES:%.c=$(BUILD)/%.o)
ENGINE   := $(filter-out $(BUILD)/src/app/main.o,$(OBJECTS))
PROGRAMS := $(TESTS:%.c=$(BUILD)/%)
SCRIPTS  := tests/house.sh $(sort $(shell find tests -name 'test_*.sh'))
LONG     := $(sort $(shell find tests -name 'long_*.sh'))

.PHONY: all run test test-long mutants fuzz lint bench install uninstall dist deb help packages packages-tests clean always
.SECONDARY:
.DEFAULT_GOAL := all

help:
	@echo 'make            builds build/cleave (options: PREFIX, CC, OPTIMISE, DEBUG=-g, ARCH=native, BUILD)'
	@echo 'make run        installs what is missing, builds what a first run needs, breaks a plate, draws it'
	@echo 'make test       installs what is missing, builds, runs every test, on $(THREADS) threads; test-long: longer ones, too'
	@echo 'make mutants    puts small faults into copies of the program and tells which tests see them (MUTANTS=LIST: others)'
	@echo 'make bench      measures kernels and efficiency (others: build/cleave bench)'
	@echo 'make fuzz       feeds scenes and files of all kinds to the readers'
	@echo 'make lint       searches the sources for faults by cppcheck and clang-tidy 14 (LINTED=FILES: in these alone)'
	@echo 'make install    below PREFIX ($(PREFIX)): program, manual, scenes, Python module, completion; uninstall removes them'
	@echo 'make dist deb   a tarball, a Debian package'
	@echo 'make clean      removes build'

all: $(BUILD)/cleave $(BUILD)/cleave.schema.json

# Tests and benches spend their time in the engine, not in code of their own: less optimisation compiles them in half the time.
$(PROGRAMS:=.o) $(BUILD)/tests/robustness/faults.o: OPTIMISE := -O1
$(BUILD)/bench/%.o: OPTIMISE := -O2

# Nor do commands, readers of scenes and shapes, studies, exports and the bookkeeping of runs take time when they run.
COLD     := app engine export geometry report scene study
$(COLD:%=$(BUILD)/src/%/%.o): OPTIMISE := -O1

# The program, and every test with all of the engine, is linked by gold in a third of the time of GNU's usual linker, and for fixed
# addresses: a start (there are thousands in the tests) has no 11,000 addresses to change first, and takes an eighth less time.
QUICK    := $(or $(call there,-fuse-ld=gold),$(call there,-fuse-ld=lld)) $(call there,-no-pie)
# Loops on one thread need no team (src/base/team_of_one.c).
QUICK    += $(call there,-Xlinker --wrap=GOMP_parallel)

# Short lines unless V=1.
Q = $(if $(V),,@echo "  $(if $(filter %.o,$@),CC,LD)  $@";)

$(BUILD)/cleave: $(OBJECTS)
	$(Q)$(CC) $(CFLAGS) $(QUICK) -o $@ $^ $(LIBS)

# Keys and words of scenes for editors, which shipped scenes name in their first line.
$(BUILD)/cleave.schema.json: $(BUILD)/cleave
	@$< help --schema > $@

$(BUILD)/%.o: %.c Makefile
	@mkdir -p $(@D)
	$(Q)$(CC) $(CPPFLAGS) $(CFLAGS) $(rest) $(LIBFLAGS) -MMD -MP -c -o $@ $<

# What this build has, for the two files that list it; written anew only where it changes.
PARTS    := $(SETS:%=KERNELS_%) $(if $(BENCHES),WITH_BENCHES)
$(BUILD)/parts.h: always
	@mkdir -p $(@D)
	@printf '#define %s\n' $(PARTS) > $@.new; cmp -s $@.new $@ && rm $@.new || mv $@.new $@
$(foreach path,$(BUILD) $(BUILD)/fuzz,$(path)/src/simd/simd.o $(path)/src/app/commands.o): $(BUILD)/parts.h

# The commit, for `cleave --version`: no object that tests link reads it, so that a commit rebuilds one file and the program.
$(BUILD)/commit.h: always
	@mkdir -p $(@D)
	@sh src/app/commit.sh $@
$(BUILD)/src/app/main.o: $(BUILD)/commit.h

# Scenes that `cleave new` writes: rows of a table of C, each a kind, what it is (its second line) and its text.
$(BUILD)/new_scenes.h: $(wildcard inputs/new/*.yaml) Makefile
	@mkdir -p $(@D)
	@awk 'FNR == 1 { kind = FILENAME; sub(/.*\//, "", kind); sub(/\.yaml/, "", kind); if (NR > 1) print "},"; next } \
	     { gsub(/\\/, "\\\\"); gsub(/"/, "\\\"") } FNR == 2 { printf "{\"%s\", \"%s\",\n", kind, substr($$0, 3); next } \
	     { printf "\"%s\\n\"\n", $$0 } END { print "}," }' $(sort $(filter %.yaml,$^)) > $@
$(BUILD)/new_part.h: inputs/new/stl.stl Makefile
	@mkdir -p $(@D)
	@awk '{ printf "\"%s\\n\"\n", $$0 }' $< > $@
$(BUILD)/src/app/new.o $(BUILD)/fuzz/src/app/new.o: $(BUILD)/new_scenes.h $(BUILD)/new_part.h

# Style, body and script of the page of `cleave report`, as texts of C. Question marks are escaped: C11 has trigraphs.
SCRIPTED := $(sort $(wildcard src/report/*.js))
quoted    = { echo 'static const char page_$(1)[] ='; cat $(2) | sed 's/[\\"?]/\\&/g; s/.*/"&\\n"/'; echo ';'; }
$(BUILD)/report_page.h: src/report/page.css src/report/page.html $(SCRIPTED) Makefile
	@mkdir -p $(@D)
	@{ $(call quoted,css,src/report/page.css); $(call quoted,html,src/report/page.html); $(call quoted,js,$(SCRIPTED)); } > $@
$(BUILD)/src/report/page.o $(BUILD)/fuzz/src/report/page.o: $(BUILD)/report_page.h

# One rule a set: build/kernels/pd/bond_force.avx2.o from kernels/pd/bond_force.c.
define SET
$(BUILD)/%.$(1).o: %.c Makefile
	@mkdir -p $$(@D)
	$$(Q)$$(CC) $$(CPPFLAGS) -DSIMD_SET='"$(1)"' $$(CFLAGS) -g1 $$($(1)) $$(LIBFLAGS) -MMD -MP -c -o $$@ $$<
endef
$(foreach set,$(SETS),$(eval $(call SET,$(set))))

# A test is linked with the parts of the engine that it calls: with all of them it would take twice as long, and 12 MB. Each starts once, so
# that shared libraries and no lines for debuggers (DEBUG=-g keeps them), which halve the time of its link, cost less than they save.
$(BUILD)/engine.a: $(ENGINE)
	@rm -f $@
	$(Q)ar rcsT $@ $^

$(PROGRAMS): %: %.o $(BUILD)/engine.a
	$(Q)$(CC) $(CFLAGS) $(QUICK) $(if $(filter -g1,$(DEBUG)),-Xlinker -S) -o $@ $(filter %.o,$^) $(filter %.a,$^) -lcmocka $(WRITERS) $(LIBS)
$(filter-out %/test_numbers,$(PROGRAMS)): LIBS = $(SHARED)

# Calls that a test lets fail, or in which it stops a run (tests/robustness/faults.c): its linker must be GNU's or like it, and calls of
# libraries must not be taken for the program's.
LINUX    := $(findstring linux,$(shell $(CC) -dumpmachine))
WRAPPED  := main malloc calloc realloc posix_memalign mmap open fopen read pread write pwrite fflush fsync close rename mkdir unlink \
            output_write_history convert_flagged_points_to_peridynamic partial_stress_compute_from_bonds bonds_largest_stretch_ratio
$(BUILD)/tests/robustness/test_faults: $(BUILD)/tests/robustness/faults.o $(if $(LINUX),$(BUILD)/src/app/main.o)
$(BUILD)/tests/robustness/test_faults: LIBS = $(SHARED) $(if $(LINUX),$(WRAPPED:%=-Wl,--wrap=%) -ldl)

# Files of these tests are written and read by the library of their format, which the program does without.
$(BUILD)/tests/unit/geometry/test_exodus_mesh $(BUILD)/tests/unit/export/test_exodus_file: WRITERS := -lnetcdf

# The fuzzer (tests/robustness/fuzz.c): sources under sanitizers, which tell it of branches; kernels as they are.
FUZZED   := -O1 -fsanitize=address,undefined -fno-sanitize-recover=all -fsanitize-coverage=trace-pc
$(BUILD)/fuzz/%.o: %.c Makefile
	@mkdir -p $(@D)
	$(Q)$(CC) $(CPPFLAGS) $(CFLAGS) $(FUZZED) $(LIBFLAGS) -MMD -MP -c -o $@ $<
$(BUILD)/fuzz/fuzz: $(BUILD)/tests/robustness/fuzz.o $(patsubst %.c,$(BUILD)/fuzz/%.o,$(wildcard tests/robustness/fuzz_*.c) \
                    $(filter-out src/app/main.c,$(wildcard src/*/*.c))) $(filter $(BUILD)/kernels/% $(BUILD)/bench/%,$(OBJECTS))
	$(Q)$(CC) $(CFLAGS) $(FUZZED) -o $@ $^ $(LIBS)

# The main job: installs what is missing, builds, breaks a steel plate, draws it.
run: packages
	@$(MAKE) --no-print-directory -j$$(getconf _NPROCESSORS_ONLN) $(if $(wildcard $(BUILD)/bench),,FIRST=1) all
	$(BUILD)/cleave run inputs/kalthoff_winkler.yaml --overwrite
	$(BUILD)/cleave plot results/kalthoff_winkler

test: packages-tests
	@$(MAKE) --no-print-directory -j$$(getconf _NPROCESSORS_ONLN) all $(PROGRAMS)
	@BUILD=$(BUILD) OMP_NUM_THREADS=$(THREADS) sh tests/support/run.sh $(SCRIPTS) $(PROGRAMS)

test-long: test
	@BUILD=$(BUILD) OMP_NUM_THREADS=$(THREADS) sh tests/support/run.sh $(LONG)

# Do tests see small faults? MUTANTS: a list of faults, else tests/robustness/mutants/list.txt.
mutants: packages-tests
	@BUILD=$(BUILD) CC="$(CC)" sh tests/robustness/mutants/run.sh $(MUTANTS)

fuzz: all
	@BUILD=$(BUILD) CC="$(CC)" sh tests/robustness/long_fuzz.sh $(FUZZ_SECONDS)

# Faults that can be seen without a run: cppcheck over all files at once, clang-tidy (.clang-tidy) over one file after the other.
LINTED   ?= $(SOURCES) $(KERNELS)
lint: $(BUILD)/commit.h $(BUILD)/parts.h $(BUILD)/new_scenes.h $(BUILD)/new_part.h $(BUILD)/report_page.h
	@BUILD=$(BUILD) LIBFLAGS="$(LIBFLAGS)" sh tests/support/lint.sh $(LINTED)

bench: all
	$(BUILD)/cleave bench kernels efficiency

# What `make install` lays below PREFIX, for `make uninstall`, too.
SHARE     = $(DESTDIR)$(PREFIX)/share
INSTALLED = $(DESTDIR)$(PREFIX)/bin/cleave $(SHARE)/man/man1/cleave.1 $(SHARE)/bash-completion/completions/cleave \
            $(SHARE)/zsh/site-functions/_cleave $(SHARE)/cleave $(SHARE)/doc/cleave $(MODULES)/cleave
# Where Python looks for modules below PREFIX; else a folder that PYTHONPATH has to name.
SEEN      = $(shell python3 -c 'import sys; print(next((p for p in sys.path if p.startswith("$(PREFIX)/") and p.endswith("-packages")), ""))' 2>/dev/null)
MODULES   = $(DESTDIR)$(or $(SEEN),$(PREFIX)/lib/python3/dist-packages)

install: all
	@$(BUILD)/cleave help --manual > $(BUILD)/cleave.1
	@$(BUILD)/cleave help --completion bash > $(BUILD)/cleave.bash
	@$(BUILD)/cleave help --completion zsh > $(BUILD)/cleave.zsh
	@$(BUILD)/cleave help --schema > $(BUILD)/cleave.schema.json
	install -D -m 755 $(BUILD)/cleave $(DESTDIR)$(PREFIX)/bin/cleave
	install -D -m 644 $(BUILD)/cleave.1 $(SHARE)/man/man1/cleave.1
	install -D -m 644 $(BUILD)/cleave.bash $(SHARE)/bash-completion/completions/cleave
	install -D -m 644 $(BUILD)/cleave.zsh $(SHARE)/zsh/site-functions/_cleave
	install -D -m 644 $(BUILD)/cleave.schema.json $(SHARE)/cleave/cleave.schema.json
	install -d $(MODULES)/cleave
	install -m 644 src/python/cleave/*.py src/python/cleave/py.typed $(MODULES)/cleave
	@sh src/app/install_documents.sh $(SHARE)/doc/cleave
	@$(if $(DESTDIR)$(SEEN),:,echo "for import cleave: export PYTHONPATH=$(MODULES)")

uninstall:
	rm -rf $(INSTALLED)

# A tarball that builds without git; of what is committed where git is there, else of what lies here.
DIST     := cleave-$(VERSION)
dist:
	@mkdir -p $(BUILD)
	@if git rev-parse --git-dir >/dev/null 2>&1; then git archive --prefix=$(DIST)/ HEAD; \
	else tar -c --transform='s|^|$(DIST)/|' $(DISTRIBUTED); fi | gzip -n9 > $(BUILD)/$(DIST).tar.gz
	@echo $(BUILD)/$(DIST).tar.gz
DISTRIBUTED := Makefile README.md LICENSE CITATION.cff CHANGELOG.md .clang-format .clang-tidy .editorconfig .ci .github \
               src include kernels bench tests inputs

# A package for Debian and its like: build/cleave_VERSION_ARCHITECTURE.deb.
deb: all
	@sh src/app/deb.sh $(BUILD) $(VERSION)

clean:
	rm -rf $(BUILD)

packages:
	@sh src/app/packages.sh

packages-tests:
	@sh src/app/packages.sh tests

-include $(OBJECTS:.o=.d) $(PROGRAMS:=.d)
