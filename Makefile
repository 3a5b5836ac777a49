# Cleave: settings
CC       ?= gcc
ARCH     ?=
OPTIMISE ?= -O3
PREFIX   ?= /usr/local
BUILD    ?= build
THREADS  ?= 2
VERSION  := 0.1.0

# Options, if the compiler knows them all.
known = $(shell $(CC) -Werror $(1) -x c -c -o /dev/null /dev/null 2>/dev/null && echo '$(1)')

WARN     := -Wall -Wextra -Wshadow -Werror=implicit-function-declaration -Wno-unknown-pragmas -Wno-psabi
WARN     += $(if $(call known,-Wpass-failed),-Wno-pass-failed)
LIBRARIES := hdf5 hwloc yaml-0.1

CPPFLAGS += -I. -Iinclude -I$(BUILD) -D_GNU_SOURCE -DCLEAVE_VERSION='"$(VERSION)"'
CFLAGS   += -std=c11 $(OPTIMISE) -g -ffp-contract=fast -fno-math-errno -fno-trapping-math -fopenmp $(WARN)
LIBFLAGS  = $(shell pkg-config --cflags $(LIBRARIES))
LIBS      = $(shell pkg-config --libs $(LIBRARIES)) -lm

# Kernels are compiled once for each set of vector instructions; the program takes one at start (src/simd/simd.c). The rest is
# for any machine of its kind, or for ARCH (native, ...).
rest     := $(ARCH:%=-march=%)
X86      := $(findstring x86_64,$(shell $(CC) -dumpmachine))
SETS     := $(if $(X86),avx512 avx2) portable
avx512   := -march=x86-64-v4 -mprefer-vector-width=512
avx2     := -march=x86-64-v3 $(call known,-mmove-max=256 -mstore-max=256)
portable := $(if $(X86),-march=x86-64,$(rest))

CPPFLAGS += $(SETS:%=-DKERNELS_%)

SOURCES  := $(sort $(shell find src bench -name '*.c'))
KERNELS  := $(sort $(shell find kernels -name '*.c'))
TESTS    := $(sort $(shell find tests -name 'test_*.c'))
OBJECTS  := $(SOURCES:%.c=$(BUILD)/%.o) $(foreach set,$(SETS),$(KERNELS:%.c=$(BUILD)/%.$(set).o))
ENGINE   := $(filter-out $(BUILD)/src/app/main.o,$(OBJECTS))
PROGRAMS := $(TESTS:%.c=$(BUILD)/%)
SCRIPTS  := tests/house.sh $(sort $(shell find tests -name 'test_*.sh'))
LONG     := $(sort $(shell find tests -name 'long_*.sh'))

.PHONY: all run test test-long fuzz bench install packages packages-tests clean
.SECONDARY:

all: $(BUILD)/cleave

# Short lines unless V=1.
Q = $(if $(V),,@echo "  $(if $(filter %.o,$@),CC,LD)  $@";)

$(BUILD)/cleave: $(OBJECTS)
	$(Q)$(CC) $(CFLAGS) -o $@ $^ $(LIBS)

$(BUILD)/%.o: %.c Makefile
	@mkdir -p $(@D)
	$(Q)$(CC) $(CPPFLAGS) $(CFLAGS) $(rest) $(LIBFLAGS) -MMD -MP -c -o $@ $<

# The cost-accuracy table that `method: auto` chooses from, as strings of C.
$(BUILD)/cost_accuracy_text.h: src/auto/cost_accuracy.csv Makefile
	@mkdir -p $(@D)
	@awk '{gsub(/"/, "\\\""); printf "\"%s\\n\"\n", $$0}' $< > $@
$(BUILD)/src/auto/cost_accuracy.o: $(BUILD)/cost_accuracy_text.h

# One rule a set: build/kernels/pd/bond_force.avx2.o from kernels/pd/bond_force.c.
define SET
$(BUILD)/%.$(1).o: %.c Makefile
	@mkdir -p $$(@D)
	$$(Q)$$(CC) $$(CPPFLAGS) -DSIMD_SET='"$(1)"' $$(CFLAGS) $$($(1)) $$(LIBFLAGS) -MMD -MP -c -o $$@ $$<
endef
$(foreach set,$(SETS),$(eval $(call SET,$(set))))

$(PROGRAMS): %: %.o $(ENGINE)
	$(Q)$(CC) $(CFLAGS) -o $@ $^ -lcmocka $(LIBS)

# Calls that a test lets fail, or in which it stops a run (tests/robustness/faults.c): its linker must be GNU's or like it.
LINUX    := $(findstring linux,$(shell $(CC) -dumpmachine))
WRAPPED  := main malloc calloc realloc posix_memalign mmap open fopen read pread write pwrite fflush fsync close rename mkdir unlink \
            output_history convert partial_stress_make
$(BUILD)/tests/robustness/test_faults: $(BUILD)/tests/robustness/faults.o $(if $(LINUX),$(BUILD)/src/app/main.o)
$(BUILD)/tests/robustness/test_faults: LIBS += $(if $(LINUX),$(WRAPPED:%=-Wl,--wrap=%) -ldl)

# The fuzzer (tests/robustness/fuzz.c): sources under sanitizers, which tell it of branches; kernels as they are.
FUZZED   := -O1 -fsanitize=address,undefined -fno-sanitize-recover=all -fsanitize-coverage=trace-pc
$(BUILD)/fuzz/%.o: %.c Makefile
	@mkdir -p $(@D)
	$(Q)$(CC) $(CPPFLAGS) $(CFLAGS) $(FUZZED) $(LIBFLAGS) -MMD -MP -c -o $@ $<
$(BUILD)/fuzz/src/auto/cost_accuracy.o: $(BUILD)/cost_accuracy_text.h
$(BUILD)/fuzz/fuzz: $(BUILD)/tests/robustness/fuzz.o $(patsubst %.c,$(BUILD)/fuzz/%.o,$(wildcard tests/robustness/fuzz_*.c) \
                    $(filter-out src/app/main.c,$(wildcard src/*/*.c))) $(filter $(BUILD)/kernels/% $(BUILD)/bench/%,$(OBJECTS))
	$(Q)$(CC) $(CFLAGS) $(FUZZED) -o $@ $^ $(LIBS)

# The main job: installs what is missing, builds, breaks a steel plate, draws it.
run: packages
	@$(MAKE) --no-print-directory -j$$(getconf _NPROCESSORS_ONLN) all
	$(BUILD)/cleave run inputs/kalthoff_winkler.yaml --overwrite
	$(BUILD)/cleave plot results/kalthoff_winkler

test: packages-tests
	@$(MAKE) --no-print-directory -j$$(getconf _NPROCESSORS_ONLN) all $(PROGRAMS)
	@BUILD=$(BUILD) OMP_NUM_THREADS=$(THREADS) sh tests/support/run.sh $(PROGRAMS) $(SCRIPTS)

test-long: test
	@BUILD=$(BUILD) OMP_NUM_THREADS=$(THREADS) sh tests/support/run.sh $(LONG)

fuzz: all
	@BUILD=$(BUILD) CC="$(CC)" sh tests/robustness/long_fuzz.sh $(FUZZ_SECONDS)

bench: all
	$(BUILD)/cleave bench kernels efficiency

install: all
	install -d $(DESTDIR)$(PREFIX)/bin $(DESTDIR)$(PREFIX)/share/man/man1
	install -m 755 $(BUILD)/cleave $(DESTDIR)$(PREFIX)/bin/cleave
	$(BUILD)/cleave help --manual > $(BUILD)/cleave.1
	install -m 644 $(BUILD)/cleave.1 $(DESTDIR)$(PREFIX)/share/man/man1/cleave.1

clean:
	rm -rf $(BUILD)

packages:
	@sh src/app/packages.sh

packages-tests:
	@sh src/app/packages.sh tests

-include $(OBJECTS:.o=.d) $(PROGRAMS:=.d)
