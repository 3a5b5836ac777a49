/* Room `export`: writes scenes for other programs. It uses the engine and all rooms below to create particles and bonds
 * of a scene; only commands call it.
 *
 * Exodus II: particles and sets of loads for other codes of peridynamics, and frames of a run for their tools.
 *
 * LAMMPS: runs the peridynamics of a scene on distributed machines, and serves as an independent check of the
 * results. */
#ifndef CLEAVE_EXPORT
#define CLEAVE_EXPORT

#include "base/base.h"
#include "scene/scene.h"

/* Request for an export. */
struct export_request {
    const char *scene, *folder;            /* path of the scene; output folder or, for Exodus, file; borrowed */
    const struct scene_override *override; /* [overrides] overrides of the scene; borrowed */
    int overrides;
    bool bond_style;      /* export for bond_style bpm/peri (2026), else for pair_style peri/pmb or peri/lps (2021) */
    bool allow_different; /* export also if LAMMPS treats something differently; its treatment is used then */
    bool overwrite;       /* replace an older export in the folder */
};

/* Exports a scene to LAMMPS: writes in.lammps, plate.data, README.txt, scene.yaml and check.csv into the folder, and
 * prints the estimated cost of the run in LAMMPS. Returns REFUSED, with the reason and without writing anything, if
 * LAMMPS cannot run the scene or would give another result, if the folder holds other files, or if it holds an export
 * and `overwrite` is false; FAILED if a file cannot be written. */
status export_lammps(const struct export_request *request);

/* Exports the particles of a scene, or the frames of a run (request->scene: its folder), to the Exodus II file
 * request->folder: spheres in a block for each material, node sets of loads, fields over time. Prints what it holds.
 * Returns REFUSED without writing anything if the scene is faulty, if particles were made during the run, or if the
 * file is there and is no export or `overwrite` is false; FAILED if it cannot be written. */
status export_exodus(const struct export_request *request);

#endif
