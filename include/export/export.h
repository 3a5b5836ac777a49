/* Room `export` (folder of include/ and src/): writes the bodies of an input file for other programs. It uses the
 * engine and all rooms below to create particles and bonds; only commands call it.
 *
 * Exodus II: particles and sets of loads for other peridynamics codes, and frames (states at one time) of a run for
 * programs that display such files.
 *
 * LAMMPS: runs the peridynamics of an input file on distributed machines, and serves as an independent check of the
 * results. */
#ifndef CLEAVE_EXPORT
#define CLEAVE_EXPORT

#include "base/base.h"
#include "scene/scene.h"

/* Options of an export of a scene to another program (`cleave export`). All pointers are borrowed. */
struct export_request {
    const char *scene, *folder;            /* path of the scene; output folder or, for Exodus, file; borrowed */
    const struct scene_override *override; /* [overrides] overrides of the scene; borrowed */
    int overrides;
    bool bond_style;      /* LAMMPS: export for bond_style bpm/peri, else for pair_style peri/pmb or peri/lps */
    bool allow_different; /* export also if LAMMPS treats something differently; its treatment is used then */
    bool overwrite;       /* replace an older export in the folder */
};

/* Exports the scene request->scene to LAMMPS: writes in.lammps, plate.data, README.txt, scene.yaml and check.csv into
 * the folder request->folder, and prints the estimated cost of the run in LAMMPS. Returns REFUSED, with the reason and
 * without writing anything, if LAMMPS cannot run the scene, or if its results would differ and request->allow_different
 * is false. Also returns REFUSED if the folder contains other files, or an export and request->overwrite is false.
 * Returns FAILED if a file cannot be written. */
status export_lammps(const struct export_request *request);

/* Exports the particles of a scene, or the frames of a run, to the Exodus II file request->folder. request->scene: the
 * scene file, or the folder of the run. The file contains particles as spheres in a block for each material, node sets
 * of loads, and fields over time. Prints these contents. Returns REFUSED without writing anything if the scene is
 * faulty, if particles were created during the run, if a file exists that is no export, or if an export exists and
 * request->overwrite is false. Returns FAILED if the file cannot be written. */
status export_exodus(const struct export_request *request);

#endif
