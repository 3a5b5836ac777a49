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

/* A key of the scene whose value differs from what LAMMPS does. value: the value that matches LAMMPS; effect: in words,
 * how results differ. All texts are constants. */
struct lammps_setting {
    const char *key, *value, *effect;
};
enum { SETTINGS_MOST = 16 }; /* largest number of such keys */

/* List of n keys of the scene whose values differ from what LAMMPS does: of[n]. */
struct lammps_settings {
    int n;
    struct lammps_setting of[SETTINGS_MOST];
};

/* Lists in *changes the keys of scene s (the input file) that must be changed so that LAMMPS gives the same results,
 * with the required values. bond_style: export for bond_style bpm/peri instead of a pair_style. Returns REFUSED, with a
 * message, if LAMMPS lacks a feature that the input file requests. */
status lammps_list_input_changes_for_equal_results(struct lammps_settings *changes, const struct scene *s,
                                                   bool bond_style);

/* Returns true if the results of LAMMPS differ in a way that no key of scene s (the input file) removes: in the
 * state-based model LAMMPS continues to normalise by the weighted volume of the intact neighbourhood after bonds have
 * broken. */
bool lammps_keeps_weighted_volume_after_bonds_break(const struct scene *s);

/* ---- colours (export_colours.c) ---------------------------------------------------------------------------------- */

/* List of n particles that LAMMPS would connect by bonds that the scene does not have. near: neighbours of list entry k
 * are near[first[k]] .. near[first[k + 1] - 1], as indices into the list; cut: 1 if the bond to this neighbour must be
 * cut. */
struct particles_at_cut_bonds {
    int64_t n;
    int32_t *particle; /* [n] */
    int64_t *first;    /* [n + 1] */
    int32_t *near;
    uint8_t *cut;
    uint64_t *key; /* [n] particles with equal keys may share a colour */
};

/* COLOURS_MOST: largest number of colours (numbers of particles, which become particle types of LAMMPS). PAIR_UNKNOWN,
 * PAIR_BONDED, PAIR_CUT: particles of two colours are not neighbours so far, have bonds, have bonds that must be
 * cut. */
enum { COLOURS_MOST = 3000 };
enum { PAIR_UNKNOWN, PAIR_BONDED, PAIR_CUT };

/* Releases the list of particles *touched, which lammps_find_bonds_to_cut has made. */
void particles_at_cut_bonds_free(struct particles_at_cut_bonds *touched);

/* Assigns a colour, a number from 0 on, to each particle of the list `touched`, the particles at bonds that LAMMPS must
 * cut. Colours become particle types of LAMMPS, of which pairs can be excluded from bonding. For any two colours, the
 * neighbouring particles with these colours all have a bond, or the bonds of all of them must be cut. Particles with
 * equal entries of touched->key share a colour where possible. Stores the colours in colour[touched->n]. Returns the
 * number of colours, or 0 if more than COLOURS_MOST (3000) are needed. */
int particles_at_cut_bonds_assign_and_count_colours(int32_t *colour, const struct particles_at_cut_bonds *touched);

/* Finds for each pair of colours (a, b) whether neighbouring particles with these colours are bonded or cut.
 * colour[touched->n]: colours of the particles in `touched`, those at bonds that LAMMPS must cut. Returns an allocated
 * array with the entry PAIR_BONDED, PAIR_CUT or PAIR_UNKNOWN (no such neighbours) at index a * colour_count + b, which
 * the caller releases with memory_free. Returns NULL if a pair of colours has both bonded and cut neighbours. */
uint8_t *colour_pairs_classify_as_bonded_or_cut(const int32_t *colour, int colour_count,
                                                const struct particles_at_cut_bonds *touched);

/* ---- bonds of LAMMPS (export_bonds.c) ---------------------------------------------------------------------------- */

/* A column of plate.data: component `axis` of a load that varies over the particles, or of the initial displacement
 * (load -1). */
struct lammps_column {
    int load, axis;
};
enum { LOADS_MOST = 28, COLUMNS_MOST = DIM_MAX * (LOADS_MOST + 1) }; /* LAMMPS has 32 groups */

/* State of an export of a scene to LAMMPS: the scene s, its run e, and what the files of LAMMPS will contain.
 * bond_style: as in struct export_request; columns: length of `column`. */
struct lammps_export {
    const struct scene *s; /* borrowed, as the run and the request */
    struct run *e;
    const struct export_request *request;
    struct lammps_settings settings; /* keys that were changed for LAMMPS */
    bool bond_style;
    real cutoff, lattice; /* cutoff of pair_coeff; lattice constant of the command `lattice` [m] */
    uint32_t *loads;      /* [particles] bit k is set if load k acts on the particle; owned */
    int columns;
    struct lammps_column column[COLUMNS_MOST]; /* columns of the data file */
    bool displaced;                            /* some particles start away from their rest position */
    int64_t bonds, cut; /* number of pairs bonded in the scene; of pairs that LAMMPS would bond in addition */
};

/* Compares the bonds that LAMMPS would create with those of Cleave. Stores the numbers of bonds in exported->bonds
 * (bonds of Cleave) and exported->cut (further bonds of LAMMPS, which must be cut). Lists in *touched the particles at
 * bonds that must be cut. Returns REFUSED, with a message, if LAMMPS would lack a bond of Cleave or give a bond another
 * weight (factor on its stiffness). Release *touched with particles_at_cut_bonds_free. */
status lammps_find_bonds_to_cut(struct particles_at_cut_bonds *touched, struct lammps_export *exported);

/* The n types of particles in LAMMPS: one for each combination of material and loads, and further ones to exclude pairs
 * of particles whose bond must be cut. */
struct lammps_types {
    int n;
    int32_t *of;             /* [particles] type, from 1 */
    int32_t *material, *any; /* [n + 1] material of a type; index of a particle with this type, -1: none */
    int64_t pairs;
    int32_t (*pair)[2]; /* [pairs] pairs of types excluded while bonds are created */
};

/* Assigns a LAMMPS type to each particle of the run of `exported`. Particles of one type have the same material and
 * loads. Where bonds must be cut, further types distinguish particles, so that pairs of types can be excluded from
 * bonding. Stores the types in *types. Returns REFUSED, with a message, if too many types are needed. Release *types
 * with lammps_types_free. */
status lammps_types_assign_to_particles(struct lammps_types *types, struct lammps_export *exported);

/* Releases the arrays of the particle types *types of LAMMPS. */
void lammps_types_free(struct lammps_types *types);

/* ---- loads (export_loads.c) -------------------------------------------------------------------------------------- */

/* Finds which loads act on each particle, and allocates exported->loads and stores them there as bits. Lists in
 * exported->column the columns with a value for each particle that the loads need in plate.data, the data file of
 * LAMMPS. Returns REFUSED, with a message, if LAMMPS has no command for a load, or not enough groups of particles for
 * all loads. */
status lammps_find_loads_of_particles(struct lammps_export *exported);

/* Computes into `velocity` the velocity [m/s] with which the particle with the index `particle` of the export
 * `exported` starts in LAMMPS. Components that a boundary condition prescribes have their value at half a time step,
 * all others the value of the initial velocity in the input file. */
void lammps_compute_initial_velocity_of_particle(const struct lammps_export *exported, int64_t particle,
                                                 real velocity[DIM_MAX]);

/* Writes the names of all per-particle columns exported->column to the file `file`, as arguments of the LAMMPS command
 * `fix property/atom`. */
void lammps_write_per_particle_column_names(FILE *file, const struct lammps_export *exported);

/* Writes one LAMMPS command `compute property/atom` for each per-particle column of the export `exported` to the file
 * `file`. Variables of the script read the columns through these commands. */
void lammps_write_compute_commands(FILE *file, const struct lammps_export *exported);

/* Returns the value of column number `column` of plate.data (the data file of LAMMPS, with a line for each particle)
 * for the particle with the index `particle` of the export `exported`: a component of the initial displacement [m], or
 * of the force of a load on the particle, 0 if the load does not act on it. The force is per volume [N/m^3] for pair
 * styles, else in [N]. */
real lammps_data_file_column_value(const struct lammps_export *exported, int column, int64_t particle);

/* Writes the LAMMPS commands of all loads and supports of the export `exported` to the file `file`. types: types of the
 * particles. */
void lammps_loads_write(FILE *file, const struct lammps_export *exported, const struct lammps_types *types);

/* ---- files ------------------------------------------------------------------------------------------------------- */

/* Writes the contents of plate.data, the data file of LAMMPS with the particles of the export `exported` with their
 * types, to the file `file` (export_data.c). types: types of the particles. */
void lammps_data_write(FILE *file, const struct lammps_export *exported, const struct lammps_types *types);

/* Writes the contents of the input script in.lammps for the export `exported` to the file `file` (export_script.c).
 * types: types of the particles. */
void lammps_script_write(FILE *file, const struct lammps_export *exported, const struct lammps_types *types);

/* Writes to the file `file` the estimated duration of the run of `exported` in LAMMPS and in Cleave, and which results
 * of Cleave LAMMPS does not compute (export_cost.c). */
void lammps_write_run_time_estimate(FILE *file, const struct lammps_export *exported);

/* Returns the number of time steps after which positions in LAMMPS and Cleave are compared: CHECK_STEPS (200), or all
 * steps of the run of `exported` if it is shorter. */
int64_t lammps_comparison_step_count(const struct lammps_export *exported);

/* Makes lammps_comparison_step_count time steps of the run of `exported` in Cleave and writes the contents of check.csv
 * to the file `file`: the positions of the particles, and the share of their bonds that is broken. Returns FAILED, with
 * a message, if a step fails. */
status lammps_run_and_write_comparison_positions(FILE *file, struct lammps_export *exported);

#endif
