namespace ChamferEditor
{
    /// <summary>How the scene view marks a hard edge.</summary>
    internal enum EdgeMark
    {
        /// <summary>It is chamfered at the width asked for.</summary>
        Full,
        /// <summary>It is chamfered, but narrower somewhere.</summary>
        Narrowed,
        /// <summary>It could not be chamfered.</summary>
        Skipped,
        /// <summary>The settings leave it out.</summary>
        NotSelected
    }
}
