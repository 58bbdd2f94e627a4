//! Checked access to the JSON of a glTF. Errors name the place as a path, `accessors[3].count`.

use anyhow::{Context, Result, anyhow, bail};
use serde_json::Value;

/// A list of the owner; empty where it is absent.
pub fn list<'a>(owner: &'a Value, key: &str) -> &'a [Value] {
    owner.get(key).and_then(Value::as_array).map_or(&[], Vec::as_slice)
}

/// One item of a list at the top of the file.
pub fn item<'a>(json: &'a Value, key: &str, index: usize) -> Result<&'a Value> {
    let items = list(json, key);
    items.get(index).with_context(|| {
        format!("{key}[{index}] is referred to, but the file has {} {key}", items.len())
    })
}

/// A whole number, also where it is written as `3.0`.
pub fn integer(value: &Value) -> Option<usize> {
    let whole = |number: f64| (number.fract() == 0.0 && number >= 0.0).then_some(number as u64);
    value.as_u64().or_else(|| value.as_f64().and_then(whole)).and_then(|n| usize::try_from(n).ok())
}

/// A count, index or offset of the owner, which may be absent.
pub fn optional(owner: &Value, key: &str, path: &str) -> Result<Option<usize>> {
    let Some(value) = owner.get(key) else { return Ok(None) };
    integer(value)
        .map(Some)
        .ok_or_else(|| anyhow!("{path}.{key} is {value}, not a whole number of at least 0"))
}

/// A count, index or offset of the owner, which must be there.
pub fn required(owner: &Value, key: &str, path: &str) -> Result<usize> {
    optional(owner, key, path)?.with_context(|| format!("{path}.{key} is missing"))
}

/// The named indices of an object such as a primitive's attributes, in the order of the file.
pub fn named_indices(owner: &Value, path: &str) -> Result<Vec<(String, usize)>> {
    let Some(object) = owner.as_object() else { bail!("{path} is not a JSON object") };
    object.keys().map(|name| Ok((name.clone(), required(owner, name, path)?))).collect()
}

/// The numbers of an array of exactly `N`; `None` where the owner has no such array.
pub fn floats<const N: usize>(owner: &Value, key: &str, path: &str) -> Result<Option<[f32; N]>> {
    let Some(value) = owner.get(key) else { return Ok(None) };
    let numbers: Vec<f32> =
        list(owner, key).iter().filter_map(|v| v.as_f64().map(|number| number as f32)).collect();
    match <[f32; N]>::try_from(numbers) {
        Ok(numbers) if numbers.iter().all(|number| number.is_finite()) => Ok(Some(numbers)),
        _ => bail!("{path}.{key} is {value}, not {N} finite numbers"),
    }
}
