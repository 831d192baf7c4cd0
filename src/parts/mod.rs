//! Printed parts: one file a part, each a plain struct and a pure function to features.
