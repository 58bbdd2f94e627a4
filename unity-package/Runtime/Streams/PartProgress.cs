using System;

namespace Chamfer.Streams
{
    /// <summary>Tells the share done of the whole, while one of its parts is done.</summary>
    internal sealed class PartProgress : IProgress<float>
    {
        private readonly IProgress<float> whole;
        private readonly int part;
        private readonly int parts;

        private PartProgress(IProgress<float> whole, int part, int parts)
        {
            this.whole = whole;
            this.part = part;
            this.parts = parts;
        }

        /// <summary>Null where nobody wants to know.</summary>
        internal static IProgress<float> Of(IProgress<float> whole, int part, int parts)
        {
            return whole == null || parts == 1 ? whole : new PartProgress(whole, part, parts);
        }

        public void Report(float done)
        {
            whole.Report((part + done) / parts);
        }
    }
}
