/* Export to LAMMPS: declarations shared by src/export. */
#ifndef CLEAVE_EXPORT_PARTS
#define CLEAVE_EXPORT_PARTS

#include <stdio.h>

#include "engine/engine.h"
#include "export/export.h"

enum {
    CHECK_STEPS = 200
}; /* step after which the positions of both programs are compared; shorter runs: the last
    * step */

/* ---- what carries over (export_carries.c) ------------------------------------------------------------------------ */

/* A key whose value differs from what LAMMPS does: the value that matches LAMMPS, and how results differ. */
struct lammps_setting {
    const char *key, *value, *effect;
};
enum { SETTINGS_MOST = 16 };

/* List of such keys. */
struct lammps_settings {
    int n;
    struct lammps_setting of[SETTINGS_MOST];
};

/* Lists the keys that must be changed for LAMMPS to run the scene. bond_style: as in struct export_request. REFUSED if
 * LAMMPS lacks a feature of the scene. */
status lammps_carries(struct lammps_settings *to, const struct scene *s, bool bond_style);

/* Returns true if bonds break in the scene and LAMMPS would keep the weights of intact families, which no key
 * changes. */
bool lammps_families_differ(const struct scene *s);

/* ---- colours (export_colours.c) ---------------------------------------------------------------------------------- */

/* Particles that LAMMPS would connect by a bond that the scene does not have. Neighbours of particle k: entries
 * first[k] .. first[k + 1] - 1 of near, as indices into this list; cut: this bond must be cut. */
struct touched {
    int64_t n;
    int32_t *particle; /* [n] */
    int64_t *first;    /* [n + 1] */
    int32_t *near;
    uint8_t *cut;
    uint64_t *key; /* [n] particles with equal keys may share a colour */
};
enum { COLOURS_MOST = 3000 };
enum { PAIR_UNKNOWN, PAIR_BONDED, PAIR_CUT };

/* Releases the arrays of t. */
void touched_free(struct touched *t);

/* Assigns colours 0, 1, ... such that no pair of colours has both bonded and cut pairs of particles. Particles with
 * equal keys share a colour where this holds. colour: [t->n]. Returns the number of colours; 0 if more than
 * COLOURS_MOST would be needed. */
int colours_make(int32_t *colour, const struct touched *t);

/* Returns the state of each pair of colours [colours * colours] (PAIR_CUT and so on), recomputed from the particles;
 * NULL if a pair has both kinds. Release with memory_free. */
uint8_t *colours_pairs(const int32_t *colour, int colours, const struct touched *t);

/* ---- bonds of LAMMPS (export_bonds.c) ---------------------------------------------------------------------------- */

/* A column of plate.data: component `axis` of a load that varies over the particles, or of the initial displacement
 * (load -1). */
struct lammps_column {
    int load, axis;
};
enum { LOADS_MOST = 28, COLUMNS_MOST = DIM_MAX * (LOADS_MOST + 1) }; /* LAMMPS has 32 groups */

/* State of an export. */
struct exported {
    const struct scene *s;
    struct run *e;
    const struct export_request *request;
    struct lammps_settings settings; /* keys that were changed for LAMMPS */
    bool bond_style;
    real cutoff, lattice; /* cutoff of pair_coeff and constant of `lattice` [m] */
    uint32_t *loads;      /* [particles] bit set of the loads that act on each */
    int columns;
    struct lammps_column column[COLUMNS_MOST];
    bool displaced;     /* some particles start away from their rest position */
    int64_t bonds, cut; /* pairs bonded in the scene; pairs that LAMMPS would bond in addition */
};

/* Compares the bonds that LAMMPS would create with those of the scene, and lists the particles of bonds to be cut.
 * REFUSED if LAMMPS would lack a bond or weight one differently. */
status lammps_touched(struct touched *t, struct exported *x);

/* Types of particles: one for each combination of material and loads, and more where bonds are cut. */
struct lammps_types {
    int n;
    int32_t *of;             /* [particles] type, from 1 */
    int32_t *material, *any; /* [n + 1] material of a type; index of a particle with this type, -1: none */
    int64_t pairs;
    int32_t (*pair)[2]; /* [pairs] pairs of types excluded while bonds are created */
};

/* Assigns the types. REFUSED if too many are needed. Release with lammps_types_free. */
status lammps_types_make(struct lammps_types *t, struct exported *x);

/* Releases the arrays of t. */
void lammps_types_free(struct lammps_types *t);

/* ---- loads (export_loads.c) -------------------------------------------------------------------------------------- */

/* Prepares the loads: marks those that act on each particle. REFUSED for a load for which LAMMPS has no command. */
status lammps_loads_make(struct exported *x);

/* Computes the initial velocity of particle i in LAMMPS; for driven particles that at half a step [m/s]. */
void lammps_velocity(const struct exported *x, int64_t i, real v[DIM_MAX]);

/* Writes the names of the columns for `fix property/atom`. */
void lammps_columns_name(FILE *to, const struct exported *x);

/* Writes one `compute property/atom` command for each column, through which variables of LAMMPS read it. */
void lammps_columns_compute(FILE *to, const struct exported *x);

/* Returns the value of a column for particle i. */
real lammps_column_value(const struct exported *x, int column, int64_t i);

/* Writes the commands of all loads. */
void lammps_loads_write(FILE *to, const struct exported *x, const struct lammps_types *t);

/* ---- files ------------------------------------------------------------------------------------------------------- */

/* Writes plate.data (export_data.c). */
void lammps_data_write(FILE *to, const struct exported *x, const struct lammps_types *t);
/* Writes in.lammps (export_script.c). */
void lammps_script_write(FILE *to, const struct exported *x, const struct lammps_types *t);
/* Writes the estimated cost of the run in LAMMPS and in Cleave, and what the export lacks (export_cost.c). */
void lammps_cost_write(FILE *to, const struct exported *x);

/* Returns the number of steps of the check: CHECK_STEPS, or all steps of a shorter run. */
int64_t lammps_check_steps(const struct exported *x);

/* Runs these steps and writes the positions of the particles and the broken share of their bonds (export_check.c). */
status lammps_check_write(FILE *to, struct exported *x);

#endif
