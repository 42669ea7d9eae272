// SPDX-License-Identifier: Apache-2.0
// A condition that few invocations meet. A software rasteriser skips loops that no lane enters, but not
// conditions: there it is a loop that runs once. Where most enter, the loop costs more than it saves. Compilers
// of GPUs take many times as long for nested loops. No break or continue in the block.
#ifdef SOFTWARE_RENDERER
#define RARELY(condition) for (bool entered = condition; entered; entered = false)
#else
#define RARELY(condition) if (condition)
#endif
