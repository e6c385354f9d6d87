// Index of the item that this invocation of Program::dispatch_items works on. Compare with the number of items: the
// last groups may run past it. A macro, because gl_WorkGroupSize is unknown before the shader's local_size layout.
#ifndef RELIGHT_ITEM_INDEX
#define RELIGHT_ITEM_INDEX

#define item_index() \
  (gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x)

#endif
