//! Where the textbook methods break: the naive way, in a few lines, fails by a stated amount beside ours, which holds.
//! What needs a device is in the workspace's own tests; that certified marches leap through nothing, in `methods/tests`,
//! and that casts against plants lose none, in `trees/tests`.

mod stability {
    mod aliasing;
    mod hashes;
    mod marching;
    mod parameters;
    mod precision;
    mod random_parameters;
    mod statistics;
}
