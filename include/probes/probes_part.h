/* Probes as a part of a run: their data, and functions for wave pulses, growing cracks, patch tests and profiles, which
 * the engine and the time step call. */
#ifndef CLEAVE_PROBES_PART
#define CLEAVE_PROBES_PART

#include "output/output.h"
#include "probes/probes.h"
#include "run/run.h"

/* The probes of a run, and reference values with which results of EXACT, PULSE and PATCH probes are compared. */
struct probing {
    struct probes probes;
    struct wave_pulse *pulse; /* [pulses] pulses of the initial states */
    int pulses;
    struct baseline baseline; /* for PULSE probes, made at the end of the run */
    bool has_baseline;        /* `baseline` is set */
    real residual_step0;      /* for PATCH probes: largest nodal force of the first step [N] */
    real strain_stress;       /* for PATCH probes: largest component of the initial stress [Pa] */
};

/* Returns the largest absolute value [Pa] among all components of the stress of all particles of p. */
real particles_largest_stress_component(const struct particles *p);

/* Stores the wave pulses among the initial states of the scene s in probing->pulse, a new array (released by
 * run_free_memory), and their number in probing->pulses. */
void scene_list_initial_wave_pulses(const struct scene *s, struct probing *probing);

/* Extends the cracks of the run with prescribed or controlled growth by the growth of one time step, and cuts the bonds
 * that they cross. The speed and direction of a crack controlled by a SIF probe (stress-intensity factors) follow from
 * the factors of the probe. Returns the number of directed bonds cut. */
int64_t cracks_grow_one_step_and_count_cut_bonds(struct run *run);

/* Stores in probing->residual_step0 the largest force component on grid nodes and on peridynamic particles of p in the
 * regions of PATCH probes of scene s [N]. Under uniform strain these forces should be 0 (patch test). Must be called in
 * the first step, after the forces have been computed and before particles are moved. */
void patch_test_store_largest_residual_force(struct probing *probing, const struct scene *s, const struct particles *p,
                                             const struct grid_method *grid);

/* Includes the nodes of `mesh`, a mesh fixed to the material, in the residual of PATCH probes of scene s:
 * probing->residual_step0 [N] increases to the largest force component on nodes in the regions of these probes, if that
 * is larger. Must be called in the first step, after the forces have been computed and before nodes are moved. */
void patch_test_include_mesh_residual_force(struct probing *probing, const struct scene *s, const struct mesh *mesh);

/* Writes the profiles of the probes as CSV files to the folder of `out`: values along a line (LINE probes), and the
 * comparison with a closed-form solution (EXACT probes). Their names contain the number of the last frame (state at one
 * time) written to `out`. o: view of the current state of the run. Returns FAILED if a file cannot be written. */
status profiles_write_csv_files(const struct probes *probes, const struct output *out, const struct observed_run *o);

/* Adds a warning to *warning_list if profiles are missing in the folder of `out` that a resumed run has already
 * written. Profiles are CSV files of LINE and EXACT probes, one for each frame (state at one time). probes: probes of
 * the run. */
void profiles_warn_of_missing_files(const struct probes *probes, const struct output *out,
                                    struct warnings *warning_list);

/* Removes the profiles (CSV files of LINE and EXACT probes) that an earlier run has left in the folder of `out`. Call
 * this function before a new run writes its own. probes: probes, whose names are those of the files. */
void profiles_remove_files_of_earlier_run(const struct probes *probes, const struct output *out);

#endif
