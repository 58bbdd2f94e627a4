//! Small models made by code, for demonstrations and tests.
