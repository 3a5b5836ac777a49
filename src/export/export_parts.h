/* Parts of the export to LAMMPS, for src/export alone. */
#ifndef CLEAVE_EXPORT_PARTS
#define CLEAVE_EXPORT_PARTS

#include <stdio.h>

#include "engine/engine.h"
#include "export/export.h"

enum { CHECK_STEPS = 200 }; /* after which positions of both programs are compared; the last one of shorter runs */

/* ---- what carries over (export_carries.c) ------------------------------------------------------------------------ */

/* A key that the scene has otherwise than LAMMPS: what LAMMPS does, and how results differ. */
struct lammps_setting {
    const char *key, *value, *effect;
};
enum { SETTINGS_MOST = 16 };
struct lammps_settings {
    int n;
    struct lammps_setting of[SETTINGS_MOST];
};

/* REFUSED for what LAMMPS cannot do at all; else the keys to change. `limit`: bonds break, and families of LAMMPS keep
 * the weight they had whole, which no key changes. */
status lammps_carries(struct lammps_settings *to, const struct scene *s, bool bond_style);
bool lammps_families_differ(const struct scene *s);

/* ---- colours (export_colours.c) ---------------------------------------------------------------------------------- */

/* Particles at which a bond of LAMMPS' would end that the scene does not have. Neighbours of k: near[first[k]] ..
 * near[first[k + 1] - 1], in this list; cut: that bond is the one. */
struct touched {
    int64_t n;
    int32_t *particle; /* [n] */
    int64_t *first;    /* [n + 1] */
    int32_t *near;
    uint8_t *cut;
    uint64_t *key; /* [n] particles of one key may have one colour */
};
enum { COLOURS_MOST = 3000 };
enum { PAIR_UNKNOWN, PAIR_BONDED, PAIR_CUT };
void touched_free(struct touched *t);

/* Colours from 0, such that no pair of colours has bonded and cut pairs of particles: shared by equal keys as far as
 * that holds, else one each. Returns how many; 0: more than COLOURS_MOST would be needed. */
int colours_make(int32_t *colour, const struct touched *t);
/* The pairs of colours [colours^2], made anew from the particles; NULL: one has both kinds. Free with memory_free. */
uint8_t *colours_pairs(const int32_t *colour, int colours, const struct touched *t);

/* ---- bonds of LAMMPS (export_bonds.c) ---------------------------------------------------------------------------- */

/* A number of each particle in plate.data: its force by a load that varies over them, or how far it is displaced at the
 * start (load -1). */
struct lammps_column {
    int load, axis;
};
enum { LOADS_MOST = 28, COLUMNS_MOST = DIM_MAX * (LOADS_MOST + 1) }; /* LAMMPS has 32 groups */

/* What both programs say of one scene. */
struct exported {
    const struct scene *s;
    struct run *e;
    const struct export_request *request;
    struct lammps_settings settings; /* what was laid over the scene */
    bool bond_style;
    real cutoff, lattice; /* of pair_coeff and `lattice` [m] */
    uint32_t *loads;      /* [particles] which loads act on it, a bit each */
    int columns;
    struct lammps_column column[COLUMNS_MOST];
    bool displaced;     /* some particles begin beside their place at rest */
    int64_t bonds, cut; /* pairs that are bonded, that LAMMPS would bond and the scene does not */
};

/* Compares the bonds that LAMMPS would make with those that there are, and lists the particles of those to be cut.
 * REFUSED where it would lack one, or weigh one otherwise. */
status lammps_touched(struct touched *t, struct exported *x);

/* Types of particles: one for those with the same material and loads, more where bonds are cut. */
struct lammps_types {
    int n;
    int32_t *of;             /* [particles] from 1 */
    int32_t *material, *any; /* [n + 1] of a type; a particle of it, -1: none */
    int64_t pairs;
    int32_t (*pair)[2]; /* [pairs] excluded while bonds are made */
};
status lammps_types_make(struct lammps_types *t, struct exported *x);
void lammps_types_free(struct lammps_types *t);

/* ---- loads (export_loads.c) -------------------------------------------------------------------------------------- */

/* REFUSED for loads that LAMMPS has no command for; marks those that act on each particle. */
status lammps_loads_make(struct exported *x);
/* Initial velocity of a particle there, as what drives it has it half a step later [m/s]. */
void lammps_velocity(const struct exported *x, int64_t i, real v[DIM_MAX]);
/* Names of the columns, for `fix property/atom`; commands by which variables read them; one of them of a particle. */
void lammps_columns_name(FILE *to, const struct exported *x);
void lammps_columns_compute(FILE *to, const struct exported *x);
real lammps_column_value(const struct exported *x, int column, int64_t i);
/* The commands of all loads. */
void lammps_loads_write(FILE *to, const struct exported *x, const struct lammps_types *t);

/* ---- files ------------------------------------------------------------------------------------------------------- */

void lammps_data_write(FILE *to, const struct exported *x, const struct lammps_types *t);   /* export_data.c */
void lammps_script_write(FILE *to, const struct exported *x, const struct lammps_types *t); /* export_script.c */
/* What the run costs there and here, and what it lacks (export_cost.c). */
void lammps_cost_write(FILE *to, const struct exported *x);

/* How many steps the check has; runs them and writes where particles then are, and the share of their bonds that have
 * broken (export_check.c). */
int64_t lammps_check_steps(const struct exported *x);
status lammps_check_write(FILE *to, struct exported *x);

#endif
