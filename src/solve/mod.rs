//! Linear systems, Newton, statics, time integration.
