mod density;
mod light;
mod march;
mod parameters;
mod shader;
mod span;
