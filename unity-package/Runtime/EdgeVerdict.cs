namespace Chamfer
{
    /// <summary>What became of a hard edge.</summary>
    public enum EdgeOutcome
    {
        /// <summary>Chamfered at the width asked for.</summary>
        Full = 0,
        /// <summary>Chamfered, but narrower somewhere.</summary>
        Narrowed = 1,
        /// <summary>Left as it was.</summary>
        Skipped = 2
    }

    /// <summary>Why a hard edge is not at full width.</summary>
    public enum EdgeReason
    {
        /// <summary>It is at full width.</summary>
        None = 0,
        /// <summary>A face beside the edge has no room.</summary>
        NoRoom = 1,
        /// <summary>The strip, or the fill at an end, would fold.</summary>
        Folds = 2,
        /// <summary>An end lies in a corner so sharp that the chamfer would shoot out as a spike.</summary>
        Miter = 3,
        /// <summary>The chamfer would cut through the mesh.</summary>
        Intersects = 4,
        /// <summary>Both ends lie inside smooth areas or on borders.</summary>
        NoEnd = 5,
        /// <summary>The faces beside the edge lie back to back.</summary>
        ZeroThickness = 6,
        /// <summary>A triangle beside the edge has no area.</summary>
        NoArea = 7,
        /// <summary>The width, or a face beside it, is too small for the precision of the positions here.</summary>
        TooFine = 8,
        /// <summary>Something rests on the edge, or right beside it: light would show behind a chamfer.</summary>
        Contact = 9,
        /// <summary>The settings leave it out: its angle, the way its faces meet, its material or the mask.</summary>
        NotSelected = 10,
        /// <summary>A vertex of one side lies in the middle of the other: the surface is open along it, or
        /// closed by triangles without area.</summary>
        TJunction = 11,
        /// <summary>A face beside the edge is wound against the other one, or against its own normals.</summary>
        Winding = 12
    }

    /// <summary>What became of one hard edge.</summary>
    public struct EdgeVerdict
    {
        /// <summary>A source vertex at its first end.</summary>
        public int FirstVertex { get; internal set; }

        /// <summary>A source vertex at its second end.</summary>
        public int SecondVertex { get; internal set; }

        /// <summary>What became of it.</summary>
        public EdgeOutcome Outcome { get; internal set; }

        /// <summary>Why it is not at full width.</summary>
        public EdgeReason Reason { get; internal set; }

        /// <summary>The width at its first end, in mesh units.</summary>
        public float FirstWidth { get; internal set; }

        /// <summary>The width at its second end, in mesh units.</summary>
        public float SecondWidth { get; internal set; }

        /// <summary>How many segments it has across; 0 where it is skipped.</summary>
        public int Segments { get; internal set; }
    }
}
