//! From what went wrong to the status, element and message that C callers see.

use std::any::Any;
use std::ffi::CStr;

use super::types::*;
use crate::smoothing::SMOOTHING_ANGLE;
use crate::{Error, Reason};

/// Why an export returns something else than `CHAMFER_STATUS_OK`.
#[derive(Debug)]
pub struct Failure {
    /// One of `CHAMFER_STATUS_*`.
    pub status: i32,
    /// What the status says it counts, or `CHAMFER_NO_ELEMENT`.
    pub element: u32,
    /// Its number in a scene, or `CHAMFER_NO_ELEMENT`.
    pub mesh: u32,
    /// The element, the rule broken, and what to do.
    pub message: String,
}

impl Failure {
    /// A failure that concerns no single element.
    pub fn new(status: i32, message: String) -> Failure {
        Failure { status, element: CHAMFER_NO_ELEMENT, mesh: CHAMFER_NO_ELEMENT, message }
    }

    /// The same, of one mesh of several.
    pub fn of_mesh(self, mesh: usize) -> Failure {
        let message = format!("mesh {mesh}: {}", self.message);
        Failure { mesh: mesh as u32, message, ..self }
    }

    /// A panic that reached the border.
    pub fn from_panic(payload: &(dyn Any + Send)) -> Failure {
        let what = payload
            .downcast_ref::<&str>()
            .copied()
            .or_else(|| payload.downcast_ref::<String>().map(String::as_str))
            .unwrap_or("unknown fault");
        Failure::new(
            CHAMFER_STATUS_INTERNAL,
            format!("internal fault, please report it with the mesh that shows it: {what}"),
        )
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Failure {
        let (status, element) = status_and_element(&error);
        Failure { element, ..Failure::new(status, error.to_string()) }
    }
}

fn status_and_element(error: &Error) -> (i32, u32) {
    const NONE: u32 = CHAMFER_NO_ELEMENT;
    match *error {
        Error::MissingNormals => (CHAMFER_STATUS_MISSING_NORMALS, NONE),
        Error::StreamLength { .. } => (CHAMFER_STATUS_STREAM_LENGTH, NONE),
        Error::UvComponents { channel, .. } => (CHAMFER_STATUS_UV_COMPONENTS, channel),
        Error::NotFinite { vertex, .. } => (CHAMFER_STATUS_NOT_FINITE, vertex),
        Error::IndexTotal { .. } => (CHAMFER_STATUS_INDEX_TOTAL, NONE),
        Error::IndexCount { submesh, .. } => (CHAMFER_STATUS_INDEX_COUNT, submesh),
        Error::IndexRange { place, .. } => (CHAMFER_STATUS_INDEX_RANGE, place),
        Error::BadWidth(_) => (CHAMFER_STATUS_BAD_WIDTH, NONE),
        Error::BadBreadth(_) | Error::BadEvenness(_) => (CHAMFER_STATUS_BAD_OPTION, NONE),
        Error::BadAngle { option: SMOOTHING_ANGLE, .. } => (CHAMFER_STATUS_BAD_ANGLE, NONE),
        Error::BadSegments(_) | Error::BadProfile(_) => (CHAMFER_STATUS_BAD_OPTION, NONE),
        Error::BadAngle { .. } | Error::AngleOrder { .. } | Error::BadScale => {
            (CHAMFER_STATUS_BAD_OPTION, NONE)
        }
        Error::BadFactor { place, .. } => (CHAMFER_STATUS_BAD_FACTOR, place),
        Error::EdgeRange { edge, .. } => (CHAMFER_STATUS_EDGE_RANGE, edge),
        Error::SubmeshRange { submesh, .. } => (CHAMFER_STATUS_SUBMESH_RANGE, submesh),
        Error::TooLarge => (CHAMFER_STATUS_TOO_LARGE, NONE),
        Error::OutOfMemory => (CHAMFER_STATUS_OUT_OF_MEMORY, NONE),
        Error::Cancelled => (CHAMFER_STATUS_CANCELLED, NONE),
    }
}

/// What a status means, in a few words.
pub fn status_text(status: i32) -> &'static CStr {
    match status {
        CHAMFER_STATUS_OK => c"ok",
        CHAMFER_STATUS_CANCELLED => c"cancelled by the progress callback",
        CHAMFER_STATUS_NULL_POINTER => c"a required pointer is NULL",
        CHAMFER_STATUS_MISALIGNED => c"a pointer is misaligned",
        CHAMFER_STATUS_STRUCT_SIZE => c"a struct_size is unknown",
        CHAMFER_STATUS_COUNT_OVERFLOW => c"a count does not fit the address space",
        CHAMFER_STATUS_BAD_WIDTH => c"the width is negative or not finite",
        CHAMFER_STATUS_BAD_OPTION => c"an option holds a value that it cannot have",
        CHAMFER_STATUS_SUBMESH_RANGE => c"the submesh for chamfers does not exist",
        CHAMFER_STATUS_BAD_ANGLE => c"the angle is not between 0 and 180 degrees",
        CHAMFER_STATUS_OVERLAP => c"places to write to lie in the mesh or in each other",
        CHAMFER_STATUS_OBJECT_MESH => c"an object is of a mesh that does not exist",
        CHAMFER_STATUS_BAD_TRANSFORM => c"the transform of an object is not finite",
        CHAMFER_STATUS_MISSING_NORMALS => c"the mesh has no normals",
        CHAMFER_STATUS_STREAM_LENGTH => c"a stream has the wrong length",
        CHAMFER_STATUS_UV_COMPONENTS => c"a UV channel is not 2 to 4 wide",
        CHAMFER_STATUS_NOT_FINITE => c"a value is infinite or not a number",
        CHAMFER_STATUS_INDEX_TOTAL => c"the submesh index counts do not add up",
        CHAMFER_STATUS_INDEX_COUNT => c"an index count is not a multiple of three",
        CHAMFER_STATUS_INDEX_RANGE => c"an index points past the last vertex",
        CHAMFER_STATUS_BAD_FACTOR => c"a factor is negative or not finite",
        CHAMFER_STATUS_EDGE_RANGE => c"a listed edge is of a vertex that does not exist",
        CHAMFER_STATUS_TOO_LARGE => c"the result does not fit 32-bit indices",
        CHAMFER_STATUS_OUT_OF_MEMORY => c"out of memory",
        CHAMFER_STATUS_INTERNAL => c"internal fault",
        _ => c"unknown status",
    }
}

/// A reason's short name for reports, as in `Reason::name`.
pub fn reason_text(reason: u32) -> &'static CStr {
    Reason::ALL.get(reason as usize).map_or(c"unknown_reason", |reason| reason.c_name())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Stream;

    #[test]
    fn a_reason_has_its_name_and_a_number_past_all_has_none() {
        assert_eq!(reason_text(CHAMFER_REASON_NO_ROOM), c"no_room");
        assert_eq!(reason_text(CHAMFER_REASON_CONTACT), c"contact");
        for number in [Reason::ALL.len() as u32, u32::MAX] {
            assert_eq!(reason_text(number), c"unknown_reason");
        }
    }

    #[test]
    fn an_error_keeps_its_element_and_words() {
        let error = Error::NotFinite { stream: Stream::Uv(2), vertex: 17 };
        let failure = Failure::from(error);
        assert_eq!((failure.status, failure.element), (CHAMFER_STATUS_NOT_FINITE, 17));
        assert_eq!(failure.message, error.to_string());
    }
}
