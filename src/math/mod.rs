//! Numbers without beams: quadrature, Hermite shape functions, rotations.
