/* The active set of the nodes of a mesh (data/active_set.h), in blocks; a cell belongs to the block of its lowest
 * node. */
#ifndef CLEAVE_ACTIVE_NODES
#define CLEAVE_ACTIVE_NODES

#include "data/mesh.h"
#include "loads/loads.h"

/* Updates after a step the list of active blocks of the mesh. A block is eight nodes beside each other along x; only
 * active blocks are computed, all others are still at rest. Normally adds the neighbours of blocks whose nodes have
 * moved. After active_nodes_activate_all_node_blocks, makes a new list: blocks that move, blocks on which the boundary
 * conditions `loads` act, and blocks with exposed points (material points to which bonds or loads attach). */
void active_nodes_update_list_of_active_node_blocks(struct mesh *mesh, const struct loads *loads);

/* Adds the blocks of nodes of `mesh` around exposed points (material points to which bonds or loads attach) to those
 * that computations include, after new points have become exposed. */
void active_nodes_activate_at_bonded_or_loaded_points(struct mesh *mesh);

/* Makes all blocks of nodes active, i.e. included in computations, until the next
 * active_nodes_update_list_of_active_node_blocks. To be called after boundary conditions or cells of the mesh have
 * changed.
 */
void active_nodes_activate_all_node_blocks(struct mesh *mesh);

#endif
