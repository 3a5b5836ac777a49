/* The active set of the nodes of a mesh (data/active_set.h); a cell belongs to the block of its lowest node. */
#ifndef CLEAVE_ACTIVE_NODES
#define CLEAVE_ACTIVE_NODES

#include "data/mesh.h"
#include "loads/loads.h"

/* After a step: finds the levels where they are not current, else activates the neighbours of blocks that have
 * moved. */
void active_nodes_update(struct mesh *mesh, const struct loads *l);
/* Cells of points that bonds have newly reached become active. */
void active_nodes_add_exposed(struct mesh *mesh);
/* All blocks become active, as what their nodes do has changed. */
void active_nodes_all(struct mesh *mesh);

#endif
