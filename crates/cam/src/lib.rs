//! Planning and linking.
