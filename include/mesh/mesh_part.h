/* Bodies in the reference frame, as a part of a run. */
#ifndef CLEAVE_MESH_PART
#define CLEAVE_MESH_PART

#include "data/hollow.h"
#include "mesh/levels.h"
#include "mesh/mesh_make.h"
#include "run/run.h"

/* Frame of a body, and why where the scene does not say current. */
struct frame_choice {
    bool reference;
    const char *reason;
};

/* Bodies in the reference frame: a mesh of cells fixed to the material. */
struct reference_frame {
    struct frame_choice *choice; /* [bodies] */
    struct mesh mesh;
    struct mesh_source source;
    struct elastic *elastic;   /* [materials] constants of its cells */
    struct mesh_levels levels; /* coarse cells */
    uint8_t *room;             /* [mesh.grid.n] level that the body is thick enough for; NULL: not asked */
    int room_most;             /* the largest of these */
    struct hollow hollow;      /* cells whose particles are not made */
    bool lacks;                /* particles that the start needs are not made: it must be made again */
    struct elastic *coarse;    /* [materials] of coarse cells, which split at less than the trigger */
    real speed;                /* largest component of a nodal velocity [m/s] */
};

#endif
