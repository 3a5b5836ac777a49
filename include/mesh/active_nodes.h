/* The active set of the nodes of a mesh (data/active_set.h), in blocks; a cell belongs to the block of its lowest
 * node. */
#ifndef CLEAVE_ACTIVE_NODES
#define CLEAVE_ACTIVE_NODES

#include "data/mesh.h"
#include "loads/loads.h"

/* Updates the active blocks after a step: finds the levels of all blocks if they are not current, else activates the
 * neighbours of blocks that have moved. */
void active_nodes_update(struct mesh *mesh, const struct loads *l);

/* Activates the cells of points that bonds have newly reached. */
void active_nodes_add_exposed(struct mesh *mesh);

/* Activates all blocks, after the behaviour of nodes has changed. */
void active_nodes_all(struct mesh *mesh);

#endif
