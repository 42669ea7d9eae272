// Indices in a dispatch of one dimension, which ShaderProgram::dispatch() folds into rows of groups where one row
// would have more than the driver takes. Included after the local size, whose y is 1. The last row may be longer
// than what is left: every user compares the index with its count.

uint linear_group() {
    return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
}

uint linear_index() {
    return linear_group() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
}
