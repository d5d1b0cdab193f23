//! The C ABI: the only unsafe code.
